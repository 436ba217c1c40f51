// The plane of a triangle in float32, and the precision of its arithmetic: the formula of scan_kernels.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/branchless.h"
#include "base/point.h"
#include "geom/tile_view.h"

namespace scarp::geom {

/// Larger heights use the slow path, since their products would overflow.
inline constexpr float kMaxScanHeight = 0x1p96f;

/// The plane of a triangle for the kernels; corners[0] is the base.
struct ScanPlane {
  float slope_x = 0, slope_y = 0, height = 0;  ///< height of the base
  float guard = 0;  ///< bound of |computed − exact error| for each sample in the closed triangle, if the sample's error
                    ///< is at most twice the given threshold; includes the threshold's own rounding to float32

  /// REQUIRES: positive orientation; heights finite, at most kMaxScanHeight in magnitude; threshold >= 0.
  static ScanPlane through(const TileView& tile, const std::array<TilePoint, 3>& corners, double threshold);

  /// Two corners relative to the base, in samples, and their heights above the base.
  struct Span {
    double qx, qy, rx, ry;  ///< multiples of 1/8, at most 2¹⁹ in magnitude
    double qz, rz;
  };
  /// The plane for a base at `height`. REQUIRES: base, q and r are counter-clockwise.
  static ScanPlane spanned(float height, const Span& span, double threshold);
};

// The guard. u = 2⁻²⁴; X = |slope_x|·width, Y = |slope_y|·depth of the box bound the products; T = threshold.
//   Slopes in double: five roundings of 2⁻⁵³ on terms that may cancel, over the triangle together at most
//     2⁻⁵⁰·reach, reach = 2(|qz| + |rz|)·width·depth/area
//   To float, its product, the sum of both:                                          3u(X + Y)
//   z − za, which is at most X + Y + the error, and the last difference, an error:   u(X + Y + 2T) + 2uT
//   threshold − guard to float:                                                       uT
// The sum is 4u(X + Y) + 5uT + 2⁻⁵⁰·reach. The code uses at least 1.6 times each term, which covers second-order terms
// and the roundings of the guard itself. Below the smallest normal number, each rounding adds up to 2⁻¹⁵⁰, and that of
// a slope 2¹² times as much: less than 2⁻¹³⁶ in all. For a level triangle, slopes are exactly 0, z − za and T round
// (3uT), and a small difference of floats is exact; so a threshold of 0 has no guard.
[[gnu::always_inline]] inline ScanPlane ScanPlane::through(const TileView& tile,
                                                           const std::array<TilePoint, 3>& corners, double threshold) {
  const auto [p, q, r] = std::array{point_of(corners[0]), point_of(corners[1]), point_of(corners[2])};
  const double height = tile.at(corners[0]);
  const Span span{static_cast<double>(q.x - p.x), static_cast<double>(q.y - p.y), static_cast<double>(r.x - p.x),
                  static_cast<double>(r.y - p.y), tile.at(corners[1]) - height,   tile.at(corners[2]) - height};
  return spanned(tile.at(corners[0]), span, threshold);
}

[[gnu::always_inline]] inline ScanPlane ScanPlane::spanned(float height, const Span& span, double threshold) {
  const auto& [qx, qy, rx, ry, qz, rz] = span;
  ScanPlane plane;
  plane.height = height;
  if (qz == 0 && rz == 0) {
    if (threshold > 0) plane.guard = static_cast<float>(0x1p-22 * threshold + 0x1p-148);
    return plane;
  }
  const double per_area = 1 / (qx * ry - qy * rx);
  const double slope_x = (qz * ry - rz * qy) * per_area, slope_y = (rz * qx - qz * rx) * per_area;
  const double width = greater(0, qx, rx) - lesser(0, qx, rx);
  const double depth = greater(0, qy, ry) - lesser(0, qy, ry);
  const double reach = 2 * (std::abs(qz) + std::abs(rz)) * per_area * (width * depth);
  const double relief = std::abs(slope_x) * width + std::abs(slope_y) * depth;
  plane.slope_x = static_cast<float>(slope_x);
  plane.slope_y = static_cast<float>(slope_y);
  plane.guard = static_cast<float>(0x1p-21 * (relief + threshold) + 0x1p-49 * reach + 0x1p-136);
  return plane;
}

}  // namespace scarp::geom
