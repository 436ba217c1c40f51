// Arbitrary polygons, and the required cover of a mesh cut to them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "grid/vertex_lattice.h"
#include "laws/fields.h"
#include "scarp/lines.h"
#include "scarp/mesh.h"

namespace scarp::testing {

inline constexpr double kNoLevel = std::numeric_limits<double>::quiet_NaN();

class Draughtsman {
 public:
  explicit Draughtsman(std::uint32_t seed) : random_(seed) {}

  std::int32_t below(std::int32_t n) { return static_cast<std::int32_t>(random_() % static_cast<std::uint32_t>(n)); }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }

  /// Arbitrary rings in columns and rows: bow-ties, slivers, on samples and far beyond the raster.
  Cutline rings(const Field& field) {
    Cutline cutline;
    const bool is_on_samples = below(3) == 0;
    for (std::uint32_t polygon = static_cast<std::uint32_t>(1 + below(3)); polygon-- > 0;) {
      for (int holes = below(3), k = 0; k <= holes; ++k) {
        Line ring = ring_of(polygon, k);
        for (int n = 3 + below(7); n > 0; --n) {
          const double reach = below(8) == 0 ? 100 : 2;
          std::array<double, 3> p{between(-reach, field.cols + reach), between(-reach, field.rows + reach), kNoLevel};
          if (is_on_samples) p = {std::round(p[0]), std::round(p[1]), kNoLevel};
          ring.points.push_back(p);
        }
        close(ring, cutline);
      }
    }
    return cutline;
  }

  /// Rectangles along the axes, with corners on the lattice.
  Cutline rectangles(const Field& field) {
    Cutline cutline;
    for (std::uint32_t polygon = static_cast<std::uint32_t>(1 + below(3)); polygon-- > 0;) {
      for (int holes = below(4), k = 0; k <= holes; ++k) {
        const auto [left, right] = side(field.cols);
        const auto [top, bottom] = side(field.rows);
        Line ring = ring_of(polygon, k);
        ring.points = {
            {left, top, kNoLevel}, {right, top, kNoLevel}, {right, bottom, kNoLevel}, {left, bottom, kNoLevel}};
        if (below(2) == 0) std::reverse(ring.points.begin(), ring.points.end());
        close(ring, cutline);
      }
    }
    return cutline;
  }

 private:
  static Line ring_of(std::uint32_t polygon, int k) {
    Line ring;
    ring.role = k == 0 ? LineRole::kOuter : LineRole::kHole;
    ring.polygon = polygon;
    ring.name = "polygon " + std::to_string(polygon);
    return ring;
  }
  static void close(Line& ring, Cutline& cutline) {
    ring.points.push_back(ring.points.front());
    cutline.rings.push_back(ring);
  }
  std::pair<double, double> side(std::int32_t size) {
    const std::int32_t grain = below(2) == 0 ? 1 : grid::kLatticeSteps,
                       steps = (size + 1) * grid::kLatticeSteps / grain;
    const std::int32_t a = below(steps), b = below(steps);
    const auto place = [&](std::int32_t step) { return static_cast<double>(step * grain) / grid::kLatticeSteps - 1; };
    return {place(std::min(a, b)), place(std::max(a, b) + 1)};
  }

  std::mt19937 random_;
};

inline bool is_in_polygons(const Cutline& cutline, double x, double y) {
  std::array<bool, 8> inside{};
  for (const Line& ring : cutline.rings) {
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
      const auto &p = ring.points[k], &q = ring.points[k + 1];
      if ((p[1] <= y) != (q[1] <= y) && p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) < x)
        inside[ring.polygon] = !inside[ring.polygon];
    }
  }
  return std::find(inside.begin(), inside.end(), true) != inside.end();
}

inline double distance_to_rings(const Cutline& cutline, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (const Line& ring : cutline.rings) {
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
      const auto &p = ring.points[k], &q = ring.points[k + 1];
      const double dx = q[0] - p[0], dy = q[1] - p[1], length = dx * dx + dy * dy;
      const double at = length > 0 ? std::clamp(((x - p[0]) * dx + (y - p[1]) * dy) / length, 0.0, 1.0) : 0.0;
      least = std::min(least, std::hypot(p[0] + at * dx - x, p[1] + at * dy - y));
    }
  }
  return least;
}

/// Valid corners of a cell, as bits.
inline int corners_of(const Field& field, std::int32_t col, std::int32_t row) {
  int corners = 0;
  for (int k = 0; k < 4; ++k) corners |= field.raster().is_valid({col + k % 2, row + k / 2}) ? 1 << k : 0;
  return corners;
}

/// Depth of a point of a cell inside the domain, negative outside.
inline double depth_in_cell(const Field& field, double x, double y) {
  const auto col = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
  const int corners = corners_of(field, col, row);
  if (corners == 15) return 1;
  for (int k = 0; k < 4; ++k) {
    if (corners != (15 & ~(1 << k))) continue;
    const double u = k % 2 == 0 ? x - col : 1 - (x - col), v = k / 2 == 0 ? y - row : 1 - (y - row);
    return u + v - 1;
  }
  return -1;
}

/// A mesh in the grid frame, in columns and rows.
struct Corner {
  double x, y, z;
};
inline std::vector<std::array<Corner, 3>> triangles_of(const Mesh& mesh, std::int32_t rows) {
  std::vector<std::array<Corner, 3>> triangles(mesh.triangle_count());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double* p = &mesh.positions[3 * std::size_t{mesh.triangles[i]}];
    triangles[i / 3][i % 3] = {mesh.origin[0] + p[0], rows - 1 - (mesh.origin[1] + p[1]), mesh.origin[2] + p[2]};
  }
  return triangles;
}

inline double doubled_area(const std::array<Corner, 3>& t) {
  return std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
}

/// Heights of all triangles at a point; empty if uncovered.
inline std::vector<double> heights_at(const std::vector<std::array<Corner, 3>>& triangles, double x, double y) {
  std::vector<double> heights;
  for (const auto& t : triangles) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &p = t[(k + 1) % 3], &q = t[(k + 2) % 3];
      weights[k] = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    }
    const bool is_held = std::all_of(weights.begin(), weights.end(), [](double w) { return w >= -1e-9; }) ||
                         std::all_of(weights.begin(), weights.end(), [](double w) { return w <= 1e-9; });
    const double sum = weights[0] + weights[1] + weights[2];
    if (is_held && sum != 0) heights.push_back((weights[0] * t[0].z + weights[1] * t[1].z + weights[2] * t[2].z) / sum);
  }
  return heights;
}

/// The first of 200 places at which triangles cover nodata or points outside the polygons, or do not cover points
/// inside; "" if none.
inline std::string find_wrong_cover(const Field& field, const Cutline& cutline,
                                    const std::vector<std::array<Corner, 3>>& triangles, Draughtsman& draughtsman) {
  constexpr double kDoubt = 1.0 / 64;
  for (int probe = 0; probe < 200; ++probe) {
    const double x = draughtsman.between(0, field.cols - 1), y = draughtsman.between(0, field.rows - 1);
    const double depth = depth_in_cell(field, x, y);
    if (distance_to_rings(cutline, x, y) < kDoubt || std::abs(depth) < 1e-6) continue;
    const bool is_wanted = depth > 0 && is_in_polygons(cutline, x, y);
    if (heights_at(triangles, x, y).empty() == is_wanted) return std::to_string(x) + ", " + std::to_string(y);
  }
  return "";
}

/// Twice the area of the part of [x0, x1] x [y0, y1] where x + y <= c.
inline std::int64_t doubled_below(std::int64_t x0, std::int64_t x1, std::int64_t y0, std::int64_t y1, std::int64_t c) {
  const auto square = [](std::int64_t t) { return t > 0 ? t * t : 0; };
  return square(c - x0 - y0) - square(c - x1 - y0) - square(c - x0 - y1) + square(c - x1 - y1);
}

/// Twice the area of the domain in a rectangle of one cell, in lattice steps.
inline std::int64_t doubled_in_cell(const Field& field, std::int32_t col, std::int32_t row,
                                    std::array<std::int64_t, 4> box) {
  const int corners = corners_of(field, col, row);
  auto [x0, x1, y0, y1] = box;
  if (corners == 15) return 2 * (x1 - x0) * (y1 - y0);
  for (int k = 0; k < 4; ++k) {
    if (corners != (15 & ~(1 << k))) continue;
    x0 -= std::int64_t{col} * grid::kLatticeSteps, x1 -= std::int64_t{col} * grid::kLatticeSteps;
    y0 -= std::int64_t{row} * grid::kLatticeSteps, y1 -= std::int64_t{row} * grid::kLatticeSteps;
    // Mirrors the cell so that the nodata corner is the last one.
    if (k % 2 == 0) std::tie(x0, x1) = std::pair(grid::kLatticeSteps - x1, grid::kLatticeSteps - x0);
    if (k / 2 == 0) std::tie(y0, y1) = std::pair(grid::kLatticeSteps - y1, grid::kLatticeSteps - y0);
    return doubled_below(x0, x1, y0, y1, grid::kLatticeSteps);
  }
  return 0;
}

/// Twice the area of the polygons' intersection with the domain, in lattice steps, summed over the rectangles between
/// all sides.
inline std::int64_t doubled_area(const Field& field, const Cutline& cutline) {
  std::vector<std::int64_t> xs, ys;
  for (std::int32_t col = 0; col < field.cols; ++col) xs.push_back(std::int64_t{col} * grid::kLatticeSteps);
  for (std::int32_t row = 0; row < field.rows; ++row) ys.push_back(std::int64_t{row} * grid::kLatticeSteps);
  for (const Line& ring : cutline.rings) {
    for (const auto& p : ring.points) {
      xs.push_back(std::clamp<std::int64_t>(std::llround(p[0] * grid::kLatticeSteps), 0,
                                            (field.cols - 1) * grid::kLatticeSteps));
      ys.push_back(std::clamp<std::int64_t>(std::llround(p[1] * grid::kLatticeSteps), 0,
                                            (field.rows - 1) * grid::kLatticeSteps));
    }
  }
  for (auto* values : {&xs, &ys}) std::sort(values->begin(), values->end());
  std::int64_t area = 0;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
      if (xs[i] == xs[i + 1] || ys[k] == ys[k + 1]) continue;
      const double x = static_cast<double>(xs[i] + xs[i + 1]) / 2 / grid::kLatticeSteps,
                   y = static_cast<double>(ys[k] + ys[k + 1]) / 2 / grid::kLatticeSteps;
      if (is_in_polygons(cutline, x, y))
        area += doubled_in_cell(field, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                                {xs[i], xs[i + 1], ys[k], ys[k + 1]});
    }
  }
  return area;
}

}  // namespace scarp::testing
