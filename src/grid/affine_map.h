// Conversion of map coordinates to columns and rows: the inverse of an affine map from samples to the map.
#pragma once

#include <array>
#include <cmath>

namespace scarp::grid {

/// A position, or a difference of positions, in samples, not rounded.
struct SamplePosition {
  double col = 0, row = 0;
};

/// Beyond this distance, doubles do not resolve a lattice step, so the place where a line enters the raster is unknown.
inline constexpr double kFarthestSample = 0x1p41;
inline bool can_be_placed(const SamplePosition& at) {
  return std::abs(at.col) <= kFarthestSample && std::abs(at.row) <= kFarthestSample;
}

class MapToSamples {
 public:
  /// `affine`: maps samples to map coordinates, like Frame::affine. REQUIRES: it is invertible.
  explicit MapToSamples(const std::array<double, 6>& affine)
      : affine_(affine), determinant_(affine[1] * affine[5] - affine[2] * affine[4]) {}

  SamplePosition position(double x, double y) const { return way(x - affine_[0], y - affine_[3]); }
  /// Converts a difference of two positions.
  SamplePosition way(double x, double y) const {
    return {(affine_[5] * x - affine_[2] * y) / determinant_, (affine_[1] * y - affine_[4] * x) / determinant_};
  }

 private:
  std::array<double, 6> affine_;
  double determinant_;
};

}  // namespace scarp::grid
