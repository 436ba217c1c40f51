// Times the arrangement of lines: seconds of one core for several kinds of lines, and of reading them from a file.
//
//   speed_lines            a Markdown table, on a raster of 3601 × 3601 samples
//   speed_lines --meshes   what lines add to the time of a mesh: 100,000 vertices on 10 million samples
//   speed_lines FILE...    reads each file, file.gpkg:layer, as it is

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

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

  /// Walks of a hundred segments of two samples, a few of which leave the raster.
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

/// Of simplify() and write_mesh(), the least of five runs; false if they fail.
bool time_mesh(const scarp::OwnedHeightField& field, const scarp::SimplifyOptions& options, double& least,
               scarp::Simplified& mesh) {
  const std::string path = (std::filesystem::temp_directory_path() / "speed_lines.glb").string();
  least = 1e9;
  for (int run = 0; run < 5; ++run) {
    const double start = seconds();
    auto made = scarp::simplify(field.view(), options);
    const bool is_written = made && scarp::write_mesh(made->mesh, path).has_value();
    const double time = seconds() - start;
    std::filesystem::remove(path);
    if (!is_written) return false;
    if (time >= least) continue;
    least = time;
    mesh = std::move(*made);
  }
  return true;
}

/// One row of the table for each kind of lines; seconds of all cores together.
bool time_meshes(const scarp::OwnedHeightField& field,
                 const std::vector<std::pair<const char*, scarp::LineConstraints>>& kinds, const char* name,
                 scarp::SimplifyOptions options) {
  double alone = 0;
  for (const auto& [lines, constraints] : kinds) {
    options.breaklines = constraints;
    double time = 0;
    scarp::Simplified mesh;
    if (!time_mesh(field, options, time, mesh)) return false;
    if (constraints.lines.empty()) alone = time;
    double arrange = 0, lay = 0;
    for (const scarp::Pass& pass : mesh.passes) {
      if (pass.name == "arrange") arrange += pass.seconds;
      if (pass.name == "lines") lay += pass.seconds;
    }
    std::printf("| %s | %g | %s | %zu | %.2f | %.2f | %.2f | %.2f |\n", name, *options.max_error, lines,
                mesh.mesh.triangle_count(), time, time / alone, arrange, lay);
    std::fflush(stdout);
  }
  return true;
}

/// From bounds that leave far fewer triangles than the lines ask for, to one that leaves several times as many.
int time_meshes() {
  constexpr int kSide = 3163;
  const auto field = scarp::generate_field(scarp::FieldStyle::kFractal, kSide, kSide);
  if (!field) return 1;
  const std::vector<std::pair<const char*, scarp::LineConstraints>> kinds{
      {"none", {}},
      {"1,000 walks", soft_lines(Drawing().walks(1000), kSide)},
      {"1,000 circles", soft_lines(Drawing().circles(1000), kSide)},
  };
  std::printf(
      "| effort | max error | lines | triangles | s | to none | arrange | lines "
      "|\n|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, effort] :
       {std::pair{"fast", scarp::Effort::kFast}, std::pair{"normal", scarp::Effort::kNormal}}) {
    for (const double error : {10.0, 5.0, 2.5}) {
      scarp::SimplifyOptions options;
      options.max_error = error;
      options.effort = effort;
      if (!time_meshes(*field, kinds, name, std::move(options))) return 1;
    }
  }
  return 0;
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
  if (argc > 1 && std::string(argv[1]) == "--meshes") return time_meshes();
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
