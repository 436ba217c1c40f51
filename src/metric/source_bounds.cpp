#include "metric/source_bounds.h"

#include <algorithm>
#include <cmath>

namespace scarp {

bool SourceBounds::has_most() const { return !std::isinf(most_); }

double SourceBounds::asked(float tolerance) const { return std::min(most_, factor_ * tolerance); }

float SourceBounds::bound(float tolerance) const { return rule_.bound(asked(tolerance)); }

Result<void> SourceBounds::read_aims(Point first, std::int32_t cols, std::int32_t rows, float* aims,
                                     std::ptrdiff_t stride) const {
  return read(first, cols, rows, nullptr, aims, stride);
}

Result<void> SourceBounds::read_aims(std::int32_t first, const Raster& samples, float* aims) const {
  return read({0, first}, samples.cols, samples.rows, &samples, aims, samples.cols);
}

Result<void> SourceBounds::read(Point first, std::int32_t cols, std::int32_t rows, const Raster* samples, float* aims,
                                std::ptrdiff_t stride) const {
  if (auto done = tolerances_.read(first.x, first.y, cols, rows, aims, stride); !done) return done;
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x) {
      float& value = aims[y * stride + x];
      const Point at{first.x + x, first.y + y};
      if (!(value >= 0)) return tl::unexpected(refuse_value("the tolerance", at, value));
      if (samples != nullptr && asked(value) < rule_.reserve && samples->is_valid({x, y}))
        return tl::unexpected(rule_.refuse(at, asked(value)));
      value = rule_.aim_at(bound(value));
    }
  }
  return {};
}

Result<void> SourceBounds::read_tolerances(std::int32_t first, std::int32_t rows, std::int32_t cols,
                                           float* tolerances) const {
  return tolerances_.read(0, first, cols, rows, tolerances, cols);
}

}  // namespace scarp
