// Any lines on any small raster: breaklines hard and soft, lakes, rivers, cliffs, ridges, cutlines, shapes, with every
// effort, to an error or a number of triangles. Either the mesh satisfies its goal for the judge, against the raster
// modified by lines, is sound, and has each line as a chain of edges; or there is an error with a message. Bytes: the
// request, a height for each sample, then three for each vertex: two coordinates and a height. Few places with many
// repeats make lines meet, overlap and turn back.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "bytes.h"
#include "scarp/features.h"
#include "scarp/lines.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace {

constexpr int kMaxSide = 12;
constexpr std::size_t kMostVertices = 48;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void require(bool holds) {
  if (!holds) std::abort();
}

/// The request in the first bytes.
struct Task {
  scarp::OwnedHeightField field;
  scarp::SimplifyOptions options;
  double cliff = 0, ridge = 0;
  std::uint64_t budget = 0;
  bool has_nodata = false, are_hard = false, are_lakes = false, are_rivers = false, is_cut = false,
       are_ridges_kept = false;
};

Task read_task(Bytes& bytes) {
  Task task;
  scarp::OwnedHeightField& field = task.field;
  field.cols = bytes.next() % kMaxSide + 2;
  field.rows = bytes.next() % kMaxSide + 2;
  field.frame = scarp::grid_frame(field.rows);
  const int levels = bytes.next() % 100 + 1;
  const float step = std::ldexp(1.0F, bytes.next() % 16 - 8);
  const std::uint8_t kinds = bytes.next(), effort = bytes.next(), shapes = bytes.next();
  task.has_nodata = (kinds & 1) != 0;
  task.are_hard = (kinds & 2) != 0;
  task.are_lakes = (kinds & 4) != 0;
  task.are_rivers = (kinds & 8) != 0;
  task.is_cut = (kinds & 16) != 0;
  task.options.goals.max_error = static_cast<double>(bytes.next()) * static_cast<double>(step) / 16;
  if ((kinds & 32) != 0) task.cliff = *task.options.goals.max_error * 2 + static_cast<double>(step);
  task.options.features.breaklines.conflict = static_cast<scarp::LineConflict>(kinds / 64);
  task.options.quality.effort = static_cast<scarp::Effort>(effort % 5);
  if (effort / 5 % 3 == 1) task.options.quality.vertices = scarp::Vertices::kSamples;
  task.options.output.float32_positions = effort < 128;
  task.options.run.threads = 1;
  if ((shapes & 3) == 1) task.options.quality.shape.min_angle = shapes / 8;
  if ((shapes & 3) == 2) task.options.quality.shape.max_edge = 0.5 + shapes / 16.0;
  if ((shapes & 7) == 3) task.options.quality.shape.grade = 0.1 + shapes / 200.0;
  if ((shapes & 7) == 4) task.ridge = (shapes / 64 + 1) * static_cast<double>(step);
  task.are_ridges_kept = (shapes & 8) != 0;
  if ((shapes & 19) == 16) task.budget = 2 + 3 * (shapes / 32U) + bytes.next();
  for (int i = 0; i < field.cols * field.rows; ++i) {
    const std::uint8_t byte = bytes.next();
    field.samples.push_back(task.has_nodata && byte >= 245 ? std::numeric_limits<float>::quiet_NaN()
                                                           : static_cast<float>(byte % levels) * step);
  }
  return task;
}

/// Mostly a multiple of a quarter sample, sometimes next to it, sometimes outside the raster.
double coordinate(std::uint8_t byte, int samples) {
  const int place = byte % 64 % (4 * samples + 8) - 6;
  return place / 4.0 + (byte >= 192 ? (byte - 192) / 1000.0 : 0);
}

/// A vertex for each three bytes; a third byte below 64 ends a line.
std::vector<scarp::Line> read_lines(Bytes& bytes, const Task& task) {
  std::vector<scarp::Line> lines;
  scarp::Line line;
  const auto close = [&] {
    if (task.is_cut || task.are_lakes) {
      line.role = scarp::LineRole::kOuter;
      line.polygon = static_cast<std::uint32_t>(lines.size());
      if (!line.points.empty() && line.points.front() != line.points.back()) line.points.push_back(line.points.front());
    }
    line.name = "line " + std::to_string(lines.size());
    if (line.points.size() >= (line.is_ring() ? 4U : 2U)) lines.push_back(line);
    line = {};
  };
  for (std::size_t k = 0; k < kMostVertices && bytes.left() > 0; ++k) {
    const double x = coordinate(bytes.next(), task.field.cols), y = coordinate(bytes.next(), task.field.rows);
    const std::uint8_t last = bytes.next();
    const bool is_hard = task.are_hard && !task.is_cut && last % 8 != 0;
    const std::array<double, 3> point{x, y, is_hard ? last / 8 / 4.0 : kNone};
    // Successive points are distinct.
    if (line.points.empty() || line.points.back()[0] != x || line.points.back()[1] != y) line.points.push_back(point);
    if (last < 64) close();
  }
  close();
  return lines;
}

using Plan = std::array<double, 2>;

constexpr double kReach = 0.0085;  // lines move by 3/512 in each coordinate

/// A piece of a line, and whether it continues beyond its ends.
struct Piece {
  Plan p, q;
  bool goes_on_before = false, goes_on_behind = false;
};

/// Clips the piece to the raster without its border, along which a line may enter at any place.
bool clip(const scarp::OwnedHeightField& field, Piece& piece) {
  const Plan whole = piece.p, way{piece.q[0] - whole[0], piece.q[1] - whole[1]};
  const Plan most{field.cols - 1.0, field.rows - 1.0};
  double begin = 0, end = 1;
  for (const std::size_t axis : {0, 1}) {
    const double from = whole[axis], low = 3 * kReach, high = most[axis] - 3 * kReach;
    const bool is_within = std::min(from, from + way[axis]) >= 0 && std::max(from, from + way[axis]) <= most[axis];
    if (is_within) continue;
    if (way[axis] == 0) return false;
    const double a = (low - from) / way[axis], b = (high - from) / way[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (begin >= end) return false;
  piece = {{whole[0] + begin * way[0], whole[1] + begin * way[1]},
           {whole[0] + end * way[0], whole[1] + end * way[1]},
           begin > 0,
           end < 1};
  return true;
}

/// Follows lines along the edges of a mesh.
class Walk {
 public:
  explicit Walk(const scarp::Mesh& mesh) : neighbours_(mesh.vertex_count()) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) places_.push_back({mesh.vertex(v)[0], mesh.vertex(v)[1]});
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t + k], b = mesh.triangles[t + (k + 1) % 3];
        neighbours_[a].insert(b);
        neighbours_[b].insert(a);
      }
    }
  }

  /// True if edges within the reach of moved lines lead from one end to the other.
  bool follows(const Piece& piece) const {
    const Plan way{piece.q[0] - piece.p[0], piece.q[1] - piece.p[1]};
    const double length = std::hypot(way[0], way[1]);
    if (length < 4 * kReach) return true;
    const auto along = [&](std::uint32_t v) {
      return ((places_[v][0] - piece.p[0]) * way[0] + (places_[v][1] - piece.p[1]) * way[1]) / length;
    };
    const auto is_beside = [&](std::uint32_t v) {
      return std::abs((places_[v][0] - piece.p[0]) * way[1] - (places_[v][1] - piece.p[1]) * way[0]) <= kReach * length;
    };
    std::vector<std::uint32_t> open;
    std::set<std::uint32_t> seen;
    for (std::uint32_t v = 0; v < places_.size(); ++v) {
      const bool is_start = along(v) <= 2 * kReach && (piece.goes_on_before || along(v) >= -2 * kReach);
      if (!is_start || !is_beside(v)) continue;
      open.push_back(v);
      seen.insert(v);
    }
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      if (along(at) >= length - 2 * kReach && (piece.goes_on_behind || along(at) <= length + 2 * kReach)) return true;
      for (const std::uint32_t next : neighbours_[at]) {
        if (is_beside(next) && seen.insert(next).second) open.push_back(next);
      }
    }
    return false;
  }

 private:
  std::vector<Plan> places_;
  std::vector<std::set<std::uint32_t>> neighbours_;
};

double largest_height(const scarp::OwnedHeightField& field) {
  double largest = 0;
  for (const float z : field.samples) largest = std::max(largest, std::isnan(z) ? 0 : std::abs(double{z}));
  return largest;
}

void judge(const Task& task, const scarp::Simplified& result) {
  scarp::OwnedHeightField edited = task.field;
  for (const scarp::SampleEdit& edit : result.edits) {
    float& sample = edited.samples[static_cast<std::size_t>(edit.row * edited.cols + edit.col)];
    require(sample == edit.before);
    sample = edit.after;
  }
  scarp::MeasureOptions options;
  if (task.is_cut) options.cutline = &task.options.features.cutline;
  const auto judged = scarp::measure(edited, result.mesh, options);
  require(judged.has_value());
  require(judged->is_sound());
  require(judged->uncovered == 0);
  if (task.budget > 0) {
    require(result.mesh.triangle_count() <= task.budget);
  } else {
    require(judged->max_error <= *task.options.goals.max_error + 1e-12 * largest_height(edited));
  }
  require(judged->max_error == result.measurement.max_error);
  require(judged->nodata_cells_covered == 0);
}

void walk(const Task& task, const scarp::Mesh& mesh) {
  if (task.has_nodata || task.is_cut) return;  // lines are then cut into pieces
  const Walk walk(mesh);
  for (const scarp::Line& line : task.options.features.breaklines.lines) {
    if (scarp::is_wall(line) || scarp::is_ridge_line(line)) continue;
    for (std::size_t k = 1; k < line.points.size(); ++k) {
      const auto &from = line.points[k - 1], &to = line.points[k];
      Piece piece{{from[0], from[1]}, {to[0], to[1]}};
      if (clip(task.field, piece)) require(walk.follows(piece));
    }
  }
}

/// Adds lakes and rivers as lines with heights, and cliffs and ridges as more lines; a cut adds none.
bool constrain(Task& task, std::vector<scarp::Line> lines) {
  const std::array<double, 6>& affine = task.field.frame.affine;
  scarp::LineConstraints& constraints = task.options.features.breaklines;
  constraints.affine = task.options.features.cutline.affine = affine;
  task.is_cut = task.is_cut && !lines.empty();
  if (task.is_cut) {
    task.options.features.cutline.rings = lines;
  } else if (!task.are_lakes && !task.are_rivers) {
    constraints.lines = lines;
  }
  std::vector<scarp::Lake> lakes;
  if (task.are_lakes) {
    scarp::WaterOptions water;
    water.affine = affine;
    auto flat = scarp::flatten_lakes(task.field, lines, water);
    require(flat.has_value());
    lakes = std::move(*flat);
    for (const scarp::Lake& lake : lakes)
      constraints.lines.insert(constraints.lines.end(), lake.shore.begin(), lake.shore.end());
  }
  if (task.are_rivers) {
    if (task.is_cut || task.are_lakes) {
      for (scarp::Line& line : lines) {
        line.role = scarp::LineRole::kLine;
        line.polygon = scarp::kNoPolygon;
        line.points.pop_back();
      }
    }
    const auto rivers = scarp::carve_rivers(task.field, lines, lakes, {affine, *task.options.goals.max_error / 2});
    require(rivers.has_value());
    for (const scarp::River& river : *rivers) {
      require(river.source >= river.mouth || !lakes.empty());
      constraints.lines.push_back(river.course);
    }
  }
  if (task.cliff > 0) {
    const auto cliffs =
        scarp::detect_cliffs(task.field, {task.cliff, *task.options.goals.max_error, affine, constraints.lines});
    if (!cliffs) return false;
    constraints.lines.insert(constraints.lines.end(), cliffs->lines.begin(), cliffs->lines.end());
  }
  if (task.ridge > 0) {
    const auto ridges = scarp::detect_ridges(
        task.field,
        {task.ridge, *task.options.goals.max_error, affine, constraints.lines, task.are_ridges_kept, 1, {}});
    require(ridges.has_value());
    for (const auto* found : {&ridges->ridges, &ridges->valleys})
      constraints.lines.insert(constraints.lines.end(), found->begin(), found->end());
  }
  if (task.budget > 0) {
    task.options.goals.max_triangles = task.budget;
    task.options.goals.max_error.reset();
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  Task task = read_task(bytes);
  if (!constrain(task, read_lines(bytes, task))) return 0;
  const auto result = scarp::simplify(task.field, task.options);
  if (!result) {
    require(!result.error().message.empty());
    require(result.error().kind != scarp::ErrorKind::kInternal);
    return 0;
  }
  judge(task, *result);
  walk(task, result->mesh);
  return 0;
}
