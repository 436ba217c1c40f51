#include "pieces/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/sort.h"
#include "grid/source_failure.h"
#include "pieces/offset_map.h"

namespace scarp::pieces {
namespace {

/// Samples currently in memory, of a raster with `rows` rows.
struct Surroundings {
  const grid::RowRange& held;
  std::int32_t rows;
  const Border& border;

  std::int32_t cols() const { return held.samples.cols; }
  float at(Point p) const { return held.row(p.y)[p.x]; }
  bool is_usable(Point p) const { return p.x >= 0 && p.y >= 0 && p.x < cols() && p.y < rows && !std::isnan(at(p)); }
};

/// 1 if the axes of rows and columns turn left, −1 if right, seen from above at the raster's centre.
double turn_in_space(const Surroundings& heights, const OffsetMap& offsets, const std::array<double, 3>& up) {
  const Point centre{heights.cols() / 2, heights.rows / 2};
  std::vector<double> x, y, z{0, 0, 0};
  offsets.map(std::array{centre, Point{centre.x - 1, centre.y}, Point{centre.x, centre.y - 1}}, x, y, z);
  double turn = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<const std::vector<double>*, 3> at{&x, &y, &z};
    const std::vector<double>&p = *at[(k + 1) % 3], &q = *at[(k + 2) % 3];
    turn += up[k] * ((p[0] - p[1]) * (q[0] - q[2]) - (q[0] - q[1]) * (p[0] - p[2]));
  }
  return turn < 0 ? -1 : 1;
}

/// The slope along an axis of the raster at a sample of a locked border: a rise over a number of steps. One step
/// without a rise if a neighbour lacks the sample beyond; no step if neither side has a height.
struct BorderSlope {
  double rise = 0;
  int steps = 1;
};

BorderSlope border_slope(const Surroundings& heights, Point p, Point step) {
  const std::int32_t last = step.x > 0 ? heights.cols() - 1 : heights.rows - 1;
  const std::int32_t place = step.x > 0 ? p.x : p.y, along = step.x > 0 ? p.y : p.x;
  const BeyondEdges& edges = heights.border.beyond;
  const std::vector<float>& before = step.x > 0 ? edges.left : edges.top;
  const std::vector<float>& after = step.x > 0 ? edges.right : edges.bottom;
  const bool is_known = (place > 0 || !before.empty()) && (place < last || !after.empty());
  if (!is_known) return {};
  const auto k = static_cast<std::size_t>(along);
  const float here = heights.at(p);
  const float low = place > 0 ? heights.at({p.x - step.x, p.y - step.y}) : before[k];
  const float high = place < last ? heights.at({p.x + step.x, p.y + step.y}) : after[k];
  return {double{std::isnan(high) ? here : high} - double{std::isnan(low) ? here : low},
          int{!std::isnan(low)} + int{!std::isnan(high)}};
}

/// Uses steps instead of positions, because rasters with a common side number its samples differently.
std::array<float, 3> border_normal(const Surroundings& heights, const Frame& frame, Point p) {
  const auto& a = frame.affine;
  const BorderSlope u = border_slope(heights, p, {1, 0}), v = border_slope(heights, p, {0, 1});
  const std::array<double, 3> across{a[1] * u.steps, a[4] * u.steps, u.rise},
      down{a[2] * v.steps, a[5] * v.steps, v.rise};
  const std::array normal{across[1] * down[2] - across[2] * down[1], across[2] * down[0] - across[0] * down[2],
                          across[0] * down[1] - across[1] * down[0]};
  if (normal[2] == 0) return {0, 0, 1};
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  const double scale = (normal[2] < 0 ? -1 : 1) / length;
  return {static_cast<float>(normal[0] * scale), static_cast<float>(normal[1] * scale),
          static_cast<float>(normal[2] * scale)};
}

/// Normals at samples.
std::vector<float> normals_at_samples(const Surroundings& heights, const Frame& frame, std::span<const Point> samples) {
  const OffsetMap offsets(heights.cols(), heights.rows, frame, 1);
  const std::array<double, 3> up = frame.space ? frame.space->up() : std::array<double, 3>{0, 0, 1};
  const double turn = frame.space ? turn_in_space(heights, offsets, up) : 0;
  std::vector<float> normals;
  normals.reserve(3 * samples.size());
  std::vector<Point> neighbours;  // west, east, north and south of each vertex; the vertex itself if missing
  std::vector<double> x, y, z;
  for (std::size_t begin = 0; begin < samples.size(); begin += kChunkVertices) {
    neighbours.clear();
    for (Point p : samples.subspan(begin, std::min(kChunkVertices, samples.size() - begin))) {
      for (Point q : {Point{p.x - 1, p.y}, Point{p.x + 1, p.y}, Point{p.x, p.y - 1}, Point{p.x, p.y + 1}})
        neighbours.push_back(heights.is_usable(q) ? q : p);
    }
    z.clear();
    for (Point p : neighbours) z.push_back(heights.at(p));
    offsets.map(neighbours, x, y, z);
    for (std::size_t k = 0; k < neighbours.size(); k += 4) {
      const auto difference = [&](std::size_t i, std::size_t j) {
        return std::array{x[j] - x[i], y[j] - y[i], z[j] - z[i]};
      };
      const auto u = difference(k, k + 1), v = difference(k + 2, k + 3);
      std::array normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      // A vertex without neighbours along its row or column has no slope.
      const bool has_slope = frame.space ? normal != std::array<double, 3>{} : normal[2] != 0;
      if (!has_slope) normal = up;
      const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      const double side = frame.space && has_slope ? turn : normal[2];
      const double scale = (side < 0 ? -1 : 1) / length;
      for (double component : normal) normals.push_back(static_cast<float>(component * scale));
    }
  }
  for (std::size_t k = 0; heights.border.is_locked && frame.is_affine() && k < samples.size(); ++k) {
    const Point p = samples[k];
    const bool is_inside = p.x > 0 && p.y > 0 && p.x + 1 < heights.cols() && p.y + 1 < heights.rows;
    if (is_inside || !heights.is_usable(p)) continue;
    const std::array<float, 3> normal = border_normal(heights, frame, p);
    std::copy(normal.begin(), normal.end(), normals.begin() + static_cast<std::ptrdiff_t>(3 * k));
  }
  return normals;
}

/// Adds the valid samples among the up to four around a point, with bilinear weights.
void add_corners(const Surroundings& heights, std::int32_t steps, Point p, std::vector<Point>& corners,
                 std::vector<double>& weights) {
  const Point first{p.x / steps, p.y / steps};
  const double u = static_cast<double>(p.x % steps) / steps, v = static_cast<double>(p.y % steps) / steps;
  for (const std::int32_t dy : {0, 1}) {
    for (const std::int32_t dx : {0, 1}) {
      const double weight = (dx == 0 ? 1 - u : u) * (dy == 0 ? 1 - v : v);
      const Point corner{first.x + dx, first.y + dy};
      if (weight == 0 || !heights.is_usable(corner)) continue;
      corners.push_back(corner);
      weights.push_back(weight);
    }
  }
}

std::vector<float> normals_at(const Surroundings& heights, const Frame& frame, std::int32_t steps,
                              std::span<const Point> points) {
  if (steps == 1) return normals_at_samples(heights, frame, points);
  std::vector<float> normals;
  normals.reserve(3 * points.size());
  std::vector<Point> corners;  // the valid samples around each point
  std::vector<double> weights;
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunkVertices) {
    corners.clear();
    weights.clear();
    ends.clear();
    for (Point p : points.subspan(begin, std::min(kChunkVertices, points.size() - begin))) {
      add_corners(heights, steps, p, corners, weights);
      ends.push_back(corners.size());
    }
    const std::vector<float> around = normals_at_samples(heights, frame, corners);
    std::size_t corner = 0;
    for (const std::size_t end : ends) {
      std::array<double, 3> sum{0, 0, 0};
      for (; corner < end; ++corner) {
        for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[corner] * double{around[3 * corner + k]};
      }
      if (sum[2] == 0) sum = {0, 0, 1};
      const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      for (const double component : sum) normals.push_back(static_cast<float>(component / length));
    }
  }
  return normals;
}

/// Indices of points, ordered by the row of samples at or above them.
std::vector<std::uint32_t> order_by_row(const LatticePoints& at) {
  std::vector<std::uint32_t> order(at.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto row = [&](std::uint32_t k) { return at.points[k].y / at.steps; };
  sort_rarely(order, [&](std::uint32_t a, std::uint32_t b) { return std::pair(row(a), a) < std::pair(row(b), b); });
  return order;
}

}  // namespace

std::vector<float> sample_normals(const HeightField& field, const LatticePoints& at, const Border& border) {
  constexpr std::int32_t kReach = 2;  // samples needed around the sample above a point
  std::vector<float> normals;
  std::vector<std::uint32_t> order;
  std::vector<Point> points;
  std::size_t next = 0;
  const auto swept = grid::sweep_rows(field, kReach, [&](const grid::RowRange& rows) -> Result<void> {
    const Surroundings heights{rows, field.rows, border};
    if (rows.begin == 0 && rows.end == field.rows) {
      normals = normals_at(heights, field.frame, at.steps, at.points);
      return {};
    }
    if (rows.begin == 0) {
      order = order_by_row(at);
      normals.resize(3 * order.size());
    }
    const std::size_t first = next;
    points.clear();
    for (; next < order.size() && at.points[order[next]].y / at.steps < rows.end; ++next)
      points.push_back(at.points[order[next]]);
    const std::vector<float> here = normals_at(heights, field.frame, at.steps, points);
    for (std::size_t k = 0; k < here.size(); ++k) normals[3 * order[first + k / 3] + k % 3] = here[k];
    return {};
  });
  if (!swept) throw grid::SourceFailure{swept.error()};
  return normals;
}

std::vector<float> row_normals(const grid::RowRange& rows, const HeightField& field, std::int32_t y) {
  std::vector<Point> samples;
  for (std::int32_t x = 0; x < field.cols; ++x) samples.push_back({x, y});
  const Border free;
  return normals_at_samples({rows, field.rows, free}, field.frame, samples);
}

}  // namespace scarp::pieces
