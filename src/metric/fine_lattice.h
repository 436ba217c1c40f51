// Interpolated samples of a raster: the refined lattice of the paper's supersampling (Scape's -frac).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "geom/scan.h"

namespace scarp::metric {

/// The finest lattice for scans of triangles. Without this limit, one sliver across a large raster would dominate the
/// cost.
inline constexpr int kFinestLattice = 32;

/// Bilinear interpolant at the lattice point (x, y) / lattice; NaN if a nodata sample contributes.
inline double interpolate(const float* samples, std::int32_t cols, std::int64_t x, std::int64_t y, int lattice) {
  const std::int64_t col = x / lattice, row = y / lattice;
  const double u = static_cast<double>(x % lattice) / lattice, v = static_cast<double>(y % lattice) / lattice;
  const auto at = [&](std::int64_t i, std::int64_t j) { return double{samples[(row + j) * cols + col + i]}; };
  const double top = u == 0 ? at(0, 0) : (1 - u) * at(0, 0) + u * at(1, 0);
  if (v == 0) return top;
  const double bottom = u == 0 ? at(0, 1) : (1 - u) * at(0, 1) + u * at(1, 1);
  return (1 - v) * top + v * bottom;
}

/// Calls visit(x, y, fx, fy) row by row for each point of the refined lattice in the closed triangle; x, y in refined
/// steps, fx, fy in samples.
template <class Visit>
void scan_fine(std::array<Point, 3> corners, int lattice, Visit&& visit) {
  for (Point& p : corners) p = {p.x * lattice, p.y * lattice};
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    for (std::int32_t x = first; x <= last; ++x)
      visit(x, y, static_cast<double>(x) / lattice, static_cast<double>(y) / lattice);
  });
}

/// The lattice of a triangle for the control f: ⌈(width + height) / (2 · area · f)⌉ steps per sample, limited by the
/// finest allowed lattice and by the range of coordinates; 1 if f is 0 (off).
inline int find_lattice(const std::array<Point, 3>& corners, double f) {
  if (!(f > 0)) return 1;
  const auto [low_x, high_x] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [low_y, high_y] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const double extent = static_cast<double>(high_x - low_x) + static_cast<double>(high_y - low_y);
  const double wanted = extent / (static_cast<double>(orient(corners[0], corners[1], corners[2])) * f);
  const int most = std::min(kMaxCoordinate / std::max({high_x, high_y, 1}), kFinestLattice);
  if (wanted >= most) return most;
  const int floor = static_cast<int>(wanted);
  return std::max(1, floor < wanted ? floor + 1 : floor);
}

}  // namespace scarp::metric
