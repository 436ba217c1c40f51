// Times the arrangement of lines: seconds of one core for several kinds of lines, and of reading them from a file.
//
//   speed_lines            a Markdown table, on a raster of 3601 × 3601 samples
//   speed_lines --meshes [PROJECT]
//                          what 100,000 vertices of lines add to the time of a mesh of 10 million samples, read and
//                          written: of a synthetic terrain, and of a real one where its raster is there
//   speed_lines FILE...    reads each file, file.gpkg:layer, as it is

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../quality/files.h"
#include "geom/arrangement.h"
#include "scarp/scarp.h"

namespace {

using scarp::Point;

constexpr std::int32_t kSize = 3600 * 256;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Drawing {
 public:
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  Point any() { return at(between(0, kSize), between(0, kSize)); }
  static Point at(double x, double y) { return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}; }

  /// Walks of a hundred segments of two samples, a few of which go out of the raster.
  scarp::Polylines walks(int count) {
    scarp::Polylines lines;
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
  scarp::Polylines circles(int count) {
    scarp::Polylines lines;
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
  scarp::Polylines chords(int count) {
    scarp::Polylines lines;
    for (; count > 0; --count) lines.add(std::vector{any(), any()});
    return lines;
  }
  static scarp::Polylines star(int count) {
    scarp::Polylines lines;
    const std::int32_t step = kSize / count;
    for (std::int32_t k = 0; k < count; ++k)
      lines.add(std::vector<Point>{{k * step, 0}, {kSize - k * step, kSize - 1}});
    return lines;
  }

 private:
  std::mt19937 random_{1};
};

void time_arrangement(const char* name, const scarp::Polylines& lines) {
  const std::vector<scarp::Segment> border{
      {{0, 0}, {kSize, 0}}, {{kSize, 0}, {kSize, kSize}}, {{kSize, kSize}, {0, kSize}}, {{0, kSize}, {0, 0}}};
  double least = 1e9;
  std::size_t vertices = 0, edges = 0;
  for (int run = 0; run < 3; ++run) {
    const double start = seconds();
    const auto arranged = scarp::arrange(lines, border, kSize, kSize);
    least = std::min(least, seconds() - start);
    vertices = arranged.vertices.size();
    edges = arranged.edges.size();
  }
  std::printf("| %s | %zu | %zu | %zu | %.2f |\n", name, lines.points.size() - lines.size(), vertices, edges, least);
  std::fflush(stdout);
}

/// In samples, on the raster as it is.
scarp::LineConstraints soft_lines(const scarp::Polylines& lines, int size) {
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

struct Times {
  double cpu = 1e9, wall = 1e9;  ///< seconds of all cores together, and by the clock
};

/// Times of the program's work: reading the raster, simplify(), writing the mesh. Nothing if that fails.
std::optional<Times> time_mesh(const std::string& raster, const scarp::SimplifyOptions& options,
                               scarp::Simplified& mesh) {
  using Clock = std::chrono::steady_clock;
  const std::string path = (std::filesystem::temp_directory_path() / "speed_lines.glb").string();
  const double start = seconds();
  const auto clock_start = Clock::now();
  const auto field = scarp::read_height_field(raster);
  if (!field) return std::nullopt;
  auto made = scarp::simplify(field->view(), options);
  const bool is_written = made && scarp::write_mesh(made->mesh, path).has_value();
  const Times times{seconds() - start, std::chrono::duration<double>(Clock::now() - clock_start).count()};
  std::filesystem::remove(path);
  if (!is_written) return std::nullopt;
  mesh = std::move(*made);
  return times;
}

/// One row of the table for each kind of lines, the first of which is none; the least of five runs, by turns.
bool time_meshes(const char* terrain, const std::string& raster, std::vector<Kind>& kinds, const char* effort,
                 scarp::SimplifyOptions options) {
  constexpr int kRuns = 5;
  std::vector<Times> least(kinds.size());
  std::vector<scarp::Simplified> meshes(kinds.size());
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      options.features.breaklines = kinds[k].lines;
      const auto times = time_mesh(raster, options, meshes[k]);
      if (!times) return false;
      least[k] = {std::min(least[k].cpu, times->cpu), std::min(least[k].wall, times->wall)};
    }
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    double arrange = 0, insert = 0;
    for (const scarp::Pass& pass : meshes[k].passes) {
      if (pass.name == "arrange") arrange += pass.seconds;
      if (pass.name == "lines") insert += pass.seconds;
    }
    std::printf("| %s | %s | %g | %s | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", terrain, effort,
                *options.goals.max_error, kinds[k].name, meshes[k].mesh.triangle_count(), least[k].cpu,
                least[k].cpu / least[0].cpu, least[k].wall, least[k].wall / least[0].wall, arrange, insert);
  }
  std::fflush(stdout);
  return true;
}

/// A raster as a file of its own.
bool write_raster(const scarp::OwnedHeightField& field, const std::string& path) {
  const auto bytes = scarp::encode_raster({field.samples, field.cols, field.rows}, scarp::RasterFormat::kGeoTiff);
  if (!bytes) return false;
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
  file.close();
  return !file.fail();
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

/// On one terrain, for bounds with fewer triangles than the lines need up to bounds with several times as many.
bool time_terrain(const char* terrain, const scarp::OwnedHeightField& field, const std::vector<double>& errors) {
  std::vector<Kind> kinds{{"none", {}},
                          {"1,000 walks", soft_lines(Drawing().walks(1000), field.cols)},
                          {"1,000 circles", soft_lines(Drawing().circles(1000), field.cols)}};
  const std::string raster = (std::filesystem::temp_directory_path() / "speed_lines.tif").string();
  bool is_timed = write_raster(field, raster);
  for (const auto& [name, effort] :
       {std::pair{"fast", scarp::Effort::kFast}, std::pair{"normal", scarp::Effort::kNormal}}) {
    for (const double error : errors) {
      scarp::SimplifyOptions options;
      options.goals.max_error = error;
      options.quality.effort = effort;
      is_timed = is_timed && time_meshes(terrain, raster, kinds, name, std::move(options));
    }
  }
  std::filesystem::remove(raster);
  return is_timed;
}

/// 10 million samples each.
int time_meshes(const std::string& project) {
  constexpr int kSide = 3163;
  std::printf(
      "| terrain | effort | max error | lines | triangles | CPU s | to none | s | to none | arrange | lines "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const auto fractal = scarp::generate_field(scarp::FieldStyle::kFractal, kSide, kSide);
  if (!fractal || !time_terrain("fractal", *fractal, {10, 5, 2.5})) return 1;
  const char* kName = "srtm3_sierra_nevada_basin_range.tif";
  const auto path = bench::find_raster(project, kName);
  if (!path) {
    std::printf("%s: skipped, it is not there\n", kName);
    return 0;
  }
  const auto sierra = scarp::read_height_field(*path);
  constexpr int kCol = 3800, kRow = 800;
  if (!sierra || sierra->cols < kCol + kSide || sierra->rows < kRow + kSide) return 1;
  return time_terrain("Sierra Nevada", crop(*sierra, kCol, kRow, kSide), {40, 20, 10}) ? 0 : 1;
}

int time_reading(const char* path) {
  const double start = seconds();
  const auto set = scarp::read_lines(path);
  if (!set) {
    std::fprintf(stderr, "speed_lines: %s\n", set.error().message.c_str());
    return 1;
  }
  std::size_t vertices = 0;
  for (const auto& line : set->lines) vertices += line.points.size();
  std::printf("%s: %zu lines, %zu vertices, %.2f s\n", path, set->lines.size(), vertices, seconds() - start);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--meshes") return time_meshes(argc > 2 ? argv[2] : ".");
  int status = EXIT_SUCCESS;
  for (int k = 1; k < argc; ++k) status |= time_reading(argv[k]);
  if (argc > 1) return status;
  Drawing drawing;
  std::printf("| lines | segments | vertices | edges | s |\n|---|---|---|---|---|\n");
  time_arrangement("1,000 walks", drawing.walks(1000));
  time_arrangement("10,000 walks", drawing.walks(10000));
  time_arrangement("10,000 circles", drawing.circles(10000));
  time_arrangement("2,000 chords", drawing.chords(2000));
  time_arrangement("5,000 chords through one place", Drawing::star(5000));
  return status;
}
