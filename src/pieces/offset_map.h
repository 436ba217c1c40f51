// From lattice points to the mesh's coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"
#include "scarp/height_field.h"

namespace scarp::pieces {

/// Number of points mapped at a time.
inline constexpr std::size_t kChunkVertices = 4096;

/// Offsets of lattice points from the frame's origin, in double. Points are mapped a few thousand at a time, since
/// double arrays for a whole mesh would determine the peak of memory.
class OffsetMap {
 public:
  OffsetMap(std::int32_t cols, std::int32_t rows, const Frame& frame, std::int32_t steps)
      : frame_(frame), steps_(steps), col0_(cols / 2), row0_(rows / 2), origin_(origin_of(frame, cols, rows)) {}

  std::array<double, 3> origin() const { return origin_; }

  /// Fills x and y for a chunk of points. Only a frame in space uses `z`, their heights.
  void map(std::span<const Point> points, std::vector<double>& x, std::vector<double>& y,
           std::vector<double>& z) const {
    for (std::vector<double>* offsets : {&x, &y}) {
      offsets->clear();
      offsets->reserve(points.size());
    }
    for (Point p : points) {
      // Affine frames use differences of indices, so that offsets that are float32 by construction are exact.
      const auto& a = frame_.affine;
      const double col = p.x / steps_, row = p.y / steps_, i = col - col0_, j = row - row0_;
      const std::array<double, 2> at =
          frame_.is_affine() ? std::array{a[1] * i + a[2] * j, a[4] * i + a[5] * j} : frame_.apply_affine(col, row);
      x.push_back(at[0]);
      y.push_back(at[1]);
    }
    if (frame_.is_affine()) return;
    if (frame_.space) {
      frame_.space->to_space(x, y, z);
    } else {
      frame_.transform->apply(x, y);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      x[k] -= origin_[0];
      y[k] -= origin_[1];
      z[k] -= origin_[2];
    }
  }

 private:
  static std::array<double, 3> origin_of(const Frame& frame, std::int32_t cols, std::int32_t rows) {
    if (frame.space) return frame.space->origin();
    const auto [x, y] = frame_origin(frame, cols, rows);
    return {x, y, 0};
  }

  const Frame& frame_;
  double steps_;
  std::int32_t col0_, row0_;
  std::array<double, 3> origin_;
};

}  // namespace scarp::pieces
