// Times the arrangement of several kinds of lines, in seconds of one core, and reading lines from a file.
//
//   speed_lines            a Markdown table, on a raster of 3601 × 3601 samples
//   speed_lines --meshes PROJECT
//                          time that 100,000 vertices of lines add to a mesh of 10 million samples, reading and writing
//                          included: on synthetic and, if available, real terrain
//   speed_lines FILE...    reads each file, file.gpkg:layer

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../harness.h"
#include "geom/arrangement.h"
#include "grid/generate.h"
#include "scarp/scarp.h"

namespace {

using scarp::Point;

constexpr std::int32_t kSize = 3600 * 256;

class Drawing {
 public:
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  Point any() { return at(between(0, kSize), between(0, kSize)); }
  static Point at(double x, double y) { return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}; }

  /// Walks of a hundred segments of two samples, a few of which leave the raster.
  scarp::geom::Polylines walks(int count) {
    scarp::geom::Polylines lines;
    std::vector<Point> line;
    for (; count > 0; --count) {
      line.clear();
      double x = between(0, kSize), y = between(0, kSize), way = between(0, 6.28);
      for (int k = 0; k <= 100; ++k) {
        line.push_back(at(x, y));
        way += between(-0.3, 0.3);
        x += 500 * std::cos(way);
        y += 500 * std::sin(way);
      }
      lines.add(line);
    }
    return lines;
  }
  scarp::geom::Polylines circles(int count) {
    scarp::geom::Polylines lines;
    std::vector<Point> line;
    for (; count > 0; --count) {
      line.clear();
      const double x = between(0, kSize), y = between(0, kSize), radius = between(50, 3000);
      for (int k = 0; k <= 100; ++k)
        line.push_back(at(x + radius * std::cos(k * 0.0628), y + radius * std::sin(k * 0.0628)));
      lines.add(line);
    }
    return lines;
  }
  scarp::geom::Polylines chords(int count) {
    scarp::geom::Polylines lines;
    for (; count > 0; --count) lines.add(std::vector{any(), any()});
    return lines;
  }
  static scarp::geom::Polylines star(int count) {
    scarp::geom::Polylines lines;
    const std::int32_t step = kSize / count;
    for (std::int32_t k = 0; k < count; ++k)
      lines.add(std::vector<Point>{{k * step, 0}, {kSize - k * step, kSize - 1}});
    return lines;
  }

 private:
  std::mt19937 random_{1};
};

void time_arrangement(const char* name, const scarp::geom::Polylines& lines) {
  const std::vector<scarp::geom::Segment> border{
      {{0, 0}, {kSize, 0}}, {{kSize, 0}, {kSize, kSize}}, {{kSize, kSize}, {0, kSize}}, {{0, kSize}, {0, 0}}};
  std::size_t vertices = 0, edges = 0;
  const bench::Times least = bench::least_of(3, [&] {
    const auto arranged = scarp::geom::arrange(lines, border, kSize, kSize);
    vertices = arranged.vertices.size();
    edges = arranged.edges.size();
  });
  std::printf("| %s | %zu | %zu | %zu | %.2f |\n", name, lines.points.size() - lines.size(), vertices, edges,
              least.cpu());
  std::fflush(stdout);
}

/// The lines as soft lines, in samples of the raster.
scarp::LineConstraints soft_lines(const scarp::geom::Polylines& lines, int size) {
  scarp::LineConstraints constraints;
  const double scale = (size - 1.0) / kSize;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    scarp::Line line;
    for (const Point p : lines[k])
      line.points.push_back({p.x * scale, p.y * scale, std::numeric_limits<double>::quiet_NaN()});
    constraints.lines.push_back(std::move(line));
  }
  return constraints;
}

struct Kind {
  const char* name;
  scarp::LineConstraints lines;
};

/// Times of the program's work: reading the raster, simplify(), writing the mesh.
bench::Times time_mesh(const std::string& raster, const scarp::SimplifyOptions& options, scarp::Simplified& mesh) {
  const std::string path = (std::filesystem::temp_directory_path() / "speed_lines.glb").string();
  const bench::Stopwatch watch;
  const auto field = bench::check(scarp::read_height_field(raster));
  mesh = bench::check(scarp::simplify(field.view(), options));
  if (const auto written = scarp::write_mesh(mesh.mesh, path); !written) bench::die(written.error().message);
  const bench::Times times = watch.read();
  std::filesystem::remove(path);
  return times;
}

/// Prints a row of the table for each kind of lines, first without lines, with the least times of five interleaved
/// runs.
void time_meshes(const char* terrain, const std::string& raster, std::vector<Kind>& kinds, const char* effort,
                 scarp::SimplifyOptions options) {
  constexpr int kRuns = 5;
  std::vector<std::array<double, 2>> least(kinds.size(), {1e9, 1e9});  // CPU, wall clock
  std::vector<scarp::Simplified> meshes(kinds.size());
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      options.features.breaklines = kinds[k].lines;
      const bench::Times times = time_mesh(raster, options, meshes[k]);
      least[k] = {std::min(least[k][0], times.cpu()), std::min(least[k][1], times.wall)};
    }
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    double arrange = 0, insert = 0;
    for (const scarp::Pass& pass : meshes[k].passes) {
      if (pass.name == "arrange") arrange += pass.seconds;
      if (pass.name == "lines") insert += pass.seconds;
    }
    std::printf("| %s | %s | %g | %s | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", terrain, effort,
                *options.goals.max_error, kinds[k].name, meshes[k].mesh.triangle_count(), least[k][0],
                least[k][0] / least[0][0], least[k][1], least[k][1] / least[0][1], arrange, insert);
  }
  std::fflush(stdout);
}

/// The window of a raster in the grid's frame.
scarp::OwnedHeightField crop(const scarp::OwnedHeightField& whole, int col, int row, int side) {
  scarp::OwnedHeightField window;
  window.cols = window.rows = side;
  window.frame = scarp::grid_frame(side);
  for (int y = row; y < row + side; ++y) {
    const auto first = whole.samples.begin() + static_cast<std::ptrdiff_t>(y) * whole.cols + col;
    window.samples.insert(window.samples.end(), first, first + side);
  }
  return window;
}

/// Times one terrain, for bounds with fewer to several times as many triangles as the lines need.
void time_terrain(const char* terrain, const scarp::OwnedHeightField& field, const std::vector<double>& errors) {
  std::vector<Kind> kinds{{"none", {}},
                          {"1,000 walks", soft_lines(Drawing().walks(1000), field.cols)},
                          {"1,000 circles", soft_lines(Drawing().circles(1000), field.cols)}};
  const std::string raster = (std::filesystem::temp_directory_path() / "speed_lines.tif").string();
  const auto bytes =
      bench::check(scarp::encode_raster({field.samples, field.cols, field.rows}, scarp::RasterFormat::kGeoTiff));
  bench::write_file(raster, {bytes.begin(), bytes.end()});
  for (const auto& [name, effort] :
       {std::pair{"fast", scarp::Effort::kFast}, std::pair{"normal", scarp::Effort::kNormal}}) {
    for (const double error : errors) {
      scarp::SimplifyOptions options;
      options.goals.max_error = error;
      options.quality.effort = effort;
      time_meshes(terrain, raster, kinds, name, std::move(options));
    }
  }
  std::filesystem::remove(raster);
}

/// Times terrains of 10 million samples each.
void time_meshes(const std::string& project) {
  constexpr int kSide = 3163;
  std::printf(
      "| terrain | effort | max error | lines | triangles | CPU s | to none | s | to none | arrange | lines "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  time_terrain("fractal", bench::check(scarp::grid::generate_field(scarp::grid::FieldStyle::kFractal, kSide, kSide)),
               {10, 5, 2.5});
  const char* kName = "srtm3_sierra_nevada_basin_range.tif";
  const auto path = bench::find_raster(project, kName);
  if (!path) bench::die(std::string(kName) + ": skipped, it is not there", 0);
  time_terrain("Sierra Nevada", crop(bench::check(scarp::read_height_field(*path)), 3800, 800, kSide), {40, 20, 10});
}

void time_reading(const std::string& path) {
  const bench::Stopwatch watch;
  const auto set = bench::check(scarp::read_lines(path));
  std::size_t vertices = 0;
  for (const auto& line : set.lines) vertices += line.points.size();
  std::printf("%s: %zu lines, %zu vertices, %.2f s\n", path.c_str(), set.lines.size(), vertices, watch.cpu());
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "speed_lines [FILE...] [--meshes PROJECT]");
  for (const std::string& path : arguments.from(0)) time_reading(path);
  if (arguments.has("--meshes")) time_meshes(arguments.value("--meshes", "."));
  if (argc > 1) return 0;
  Drawing drawing;
  std::printf("| lines | segments | vertices | edges | s |\n|---|---|---|---|---|\n");
  time_arrangement("1,000 walks", drawing.walks(1000));
  time_arrangement("10,000 walks", drawing.walks(10000));
  time_arrangement("10,000 circles", drawing.circles(10000));
  time_arrangement("2,000 chords", drawing.chords(2000));
  time_arrangement("5,000 chords through one place", Drawing::star(5000));
}
