#include "field_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "grid/affine_map.h"
#include "grid/vertex_places.h"
#include "line_marks.h"

namespace scarp {

namespace {

/// A vertex of a ring, on the map and in samples.
struct RingPoint {
  std::array<double, 3> on_map;
  std::array<double, 2> at;  ///< column, row
};

class RingClipper {
 public:
  RingClipper(const std::array<double, 6>& affine, std::int32_t cols, std::int32_t rows)
      : affine_(affine), to_samples_(affine), last_{cols - 1.0, rows - 1.0} {}

  Line clip(const Line& ring) {
    points_.clear();
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) points_.push_back(place(ring.points[k]));
    const bool is_within = std::all_of(points_.begin(), points_.end(), [this](const RingPoint& p) {
      return p.at[0] >= 0 && p.at[1] >= 0 && p.at[0] <= last_[0] && p.at[1] <= last_[1];
    });
    if (is_within) return ring;
    for (const std::size_t axis : {0, 1}) {
      clip_at(axis, 0, 1);
      clip_at(axis, last_[axis], -1);
    }
    Line clipped = ring;
    clipped.points.clear();
    for (const RingPoint& p : points_) {
      if (clipped.points.empty() || clipped.points.back() != p.on_map) clipped.points.push_back(p.on_map);
    }
    if (!clipped.points.empty()) clipped.points.push_back(clipped.points.front());
    return clipped;
  }

 private:
  RingPoint place(const std::array<double, 3>& point) const {
    const SamplePlace at = to_samples_.place(point[0], point[1]);
    return {{point[0], point[1], std::numeric_limits<double>::quiet_NaN()}, {at.col, at.row}};
  }

  /// Keeps what is not beyond a line: direction · (coordinate − limit) >= 0.
  void clip_at(std::size_t axis, double limit, double direction) {
    clipped_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const RingPoint &p = points_[k], &q = points_[k + 1 == points_.size() ? 0 : k + 1];
      const double from = direction * (p.at[axis] - limit), to = direction * (q.at[axis] - limit);
      if (from >= 0) clipped_.push_back(p);
      if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
        RingPoint between;
        between.at[axis] = limit;
        const std::size_t other = 1 - axis;
        between.at[other] = p.at[other] + from / (from - to) * (q.at[other] - p.at[other]);
        between.on_map = {affine_[0] + affine_[1] * between.at[0] + affine_[2] * between.at[1],
                          affine_[3] + affine_[4] * between.at[0] + affine_[5] * between.at[1],
                          std::numeric_limits<double>::quiet_NaN()};
        clipped_.push_back(between);
      }
    }
    std::swap(points_, clipped_);
  }

  std::array<double, 6> affine_;
  MapToSamples to_samples_;
  std::array<double, 2> last_;
  std::vector<RingPoint> points_, clipped_;
};

std::size_t index_of(std::int32_t col, std::int32_t row, std::int32_t cols) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
}

/// The largest whole number that is not above a / b. REQUIRES: b > 0.
std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// Calls visit(col, row) for the cells that an edge lies in, with some beside it, and each cell of the raster only.
template <class Visit>
void visit_cells(Point p, Point q, std::int32_t cols, std::int32_t rows, const Visit& visit) {
  if (p.y > q.y) std::swap(p, q);
  const auto cell = [](double steps, std::int32_t cells) {
    return std::clamp(static_cast<std::int32_t>(std::floor(steps / kLatticeSteps)), 0, cells - 1);
  };
  const double height = q.y - p.y, slope = height > 0 ? (q.x - p.x) / height : 0;
  for (std::int32_t row = cell(p.y, rows - 1); row <= cell(q.y, rows - 1); ++row) {
    const double top = std::max<double>(p.y, double{kLatticeSteps} * row),
                 bottom = std::min<double>(q.y, double{kLatticeSteps} * (row + 1.0));
    const double from = height > 0 ? p.x + slope * (top - p.y) : p.x,
                 to = height > 0 ? p.x + slope * (bottom - p.y) : q.x;
    const std::int32_t last = cell(std::max(from, to), cols - 1);
    for (std::int32_t col = cell(std::min(from, to), cols - 1); col <= last; ++col) visit(col, row);
  }
}

/// Marks what lies within `reach` of a marked one, in a line of `count` that are `stride` apart.
void spread(std::vector<std::uint8_t>& marks, std::size_t first, std::size_t stride, std::int32_t count,
            std::vector<std::uint8_t>& line) {
  line.assign(static_cast<std::size_t>(count), 0);
  for (std::int32_t i = 0; i < count; ++i) {
    if (marks[first + static_cast<std::size_t>(i) * stride] == 0) continue;
    // Cell i has the samples i and i + 1; the cells beside it have one more each.
    for (std::int32_t k = std::max(i - 1, 0); k <= std::min(i + 2, count - 1); ++k)
      line[static_cast<std::size_t>(k)] = 1;
  }
  for (std::int32_t i = 0; i < count; ++i)
    marks[first + static_cast<std::size_t>(i) * stride] = line[static_cast<std::size_t>(i)];
}

}  // namespace

std::vector<Line> clip_rings(const Cutline& cutline, std::int32_t cols, std::int32_t rows) {
  RingClipper clipper(cutline.affine, cols, rows);
  std::vector<Line> clipped;
  for (const Line& ring : cutline.rings) {
    Line within = clipper.clip(ring);
    if (within.points.size() >= 4) clipped.push_back(std::move(within));
  }
  return clipped;
}

std::vector<CutSide> sides_of_samples(std::span<const std::array<Point, 2>> walls, std::int32_t cols,
                                      std::int32_t rows) {
  constexpr std::uint8_t kTurn = 1, kOn = 2;
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), 0);
  const auto mark_point = [&](Point p) {
    if (p.x % kLatticeSteps == 0 && p.y % kLatticeSteps == 0)
      marks[index_of(p.x / kLatticeSteps, p.y / kLatticeSteps, cols)] |= kOn;
  };
  for (auto [p, q] : walls) {
    mark_point(p);
    mark_point(q);
    if (p.y > q.y || (p.y == q.y && p.x > q.x)) std::swap(p, q);
    if (p.y == q.y) {
      if (p.y % kLatticeSteps != 0) continue;
      for (std::int64_t col = -floor_divide(-p.x, kLatticeSteps); col * kLatticeSteps <= q.x; ++col)
        marks[index_of(static_cast<std::int32_t>(col), p.y / kLatticeSteps, cols)] |= kOn;
      continue;
    }
    const std::int64_t dx = q.x - p.x, dy = q.y - p.y;
    // Half open, so that a vertex on a row counts once.
    for (std::int64_t row = -floor_divide(-p.y, kLatticeSteps); row * kLatticeSteps < q.y; ++row) {
      const std::int64_t along = p.x * dy + (row * kLatticeSteps - p.y) * dx, step = kLatticeSteps * dy;
      const std::int64_t before = floor_divide(along, step);
      if (before * step == along)
        marks[index_of(static_cast<std::int32_t>(before), static_cast<std::int32_t>(row), cols)] |= kOn;
      if (before + 1 < cols)
        marks[index_of(static_cast<std::int32_t>(before + 1), static_cast<std::int32_t>(row), cols)] ^= kTurn;
    }
  }
  std::vector<CutSide> sides(marks.size(), CutSide::kBeyond);
  for (std::int32_t row = 0; row < rows; ++row) {
    bool is_within = false;
    for (std::size_t i = index_of(0, row, cols); i < index_of(0, row + 1, cols); ++i) {
      if ((marks[i] & kTurn) != 0) is_within = !is_within;
      sides[i] = (marks[i] & kOn) != 0 ? CutSide::kOnWall : is_within ? CutSide::kWithin : CutSide::kBeyond;
    }
  }
  return sides;
}

bool void_beyond(std::span<const std::array<Point, 2>> walls, std::span<const CutSide> sides, std::int32_t cols,
                 std::int32_t rows, std::span<float> samples) {
  // By cell, at the place of its first sample.
  std::vector<std::uint8_t> marks(samples.size(), 0);
  const auto is_held = [&](std::int32_t col, std::int32_t row) {
    return sides[index_of(col, row, cols)] != CutSide::kBeyond;
  };
  for (std::int32_t row = 0; row + 1 < rows; ++row) {
    for (std::int32_t col = 0; col + 1 < cols; ++col)
      marks[index_of(col, row, cols)] =
          is_held(col, row) || is_held(col + 1, row) || is_held(col, row + 1) || is_held(col + 1, row + 1);
  }
  for (const auto& [p, q] : walls)
    visit_cells(p, q, cols, rows, [&](std::int32_t col, std::int32_t row) { marks[index_of(col, row, cols)] = 1; });
  bool any = false;
  for (std::int32_t row = 0; row + 1 < rows && !any; ++row) {
    for (std::int32_t col = 0; col + 1 < cols && !any; ++col) {
      if (marks[index_of(col, row, cols)] == 0) continue;
      int valid = 0;
      for (const std::size_t i : {index_of(col, row, cols), index_of(col + 1, row, cols), index_of(col, row + 1, cols),
                                  index_of(col + 1, row + 1, cols)})
        valid += std::isnan(samples[i]) ? 0 : 1;
      any = valid >= 3;
    }
  }
  std::vector<std::uint8_t> line;
  for (std::int32_t row = 0; row < rows; ++row) spread(marks, index_of(0, row, cols), 1, cols, line);
  for (std::int32_t col = 0; col < cols; ++col)
    spread(marks, index_of(col, 0, cols), static_cast<std::size_t>(cols), rows, line);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (marks[i] == 0) samples[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return any;
}

Result<std::vector<Line>> close_rings(std::vector<Line> lines) {
  std::uint32_t polygons = 0;
  for (const Line& line : lines) {
    if (line.polygon != kNoPolygon) polygons = std::max(polygons, line.polygon + 1);
  }
  for (Line& line : lines) {
    if (line.is_ring()) continue;
    const auto &first = line.points.front(), &last = line.points.back();
    if (first[0] != last[0] || first[1] != last[1] || line.points.size() < 4)
      return fail(ErrorKind::kInput,
                  fmt::format("{} is an open line, which holds no surface: a cutline needs polygons or closed lines",
                              line.name));
    line.role = LineRole::kOuter;
    line.polygon = polygons++;
  }
  return lines;
}

std::uint64_t void_outside(OwnedHeightField& field, const Cutline& cutline) {
  LineMarks marks(cutline.affine, field.cols, field.rows);
  marks.add_polygons(cutline.rings);
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    if (marks.has(i) || std::isnan(field.samples[i])) continue;
    field.samples[i] = std::numeric_limits<float>::quiet_NaN();
    ++lost;
  }
  return lost;
}

}  // namespace scarp
