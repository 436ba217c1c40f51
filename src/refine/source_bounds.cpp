#include "refine/source_bounds.h"

#include <algorithm>
#include <cmath>

namespace scarp {

bool SourceBounds::has_most() const { return !std::isinf(most_); }

float SourceBounds::bound(float tolerance) const { return rule_.bound(std::min(most_, double{tolerance})); }

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
      const double asked = std::min(most_, double{value});
      if (samples != nullptr && asked < rule_.reserve && samples->is_valid({x, y}))
        return tl::unexpected(rule_.refuse(at, asked));
      value = rule_.aim_at(bound(value));
    }
  }
  return {};
}

Result<void> SourceBounds::read_row(std::int32_t row, std::span<float> tolerances, std::span<float> bounds) const {
  const auto cols = static_cast<std::int32_t>(tolerances.size());
  if (auto read = tolerances_.read(0, row, cols, 1, tolerances.data(), cols); !read) return read;
  std::transform(tolerances.begin(), tolerances.end(), bounds.begin(), [this](float asked) { return bound(asked); });
  return {};
}

}  // namespace scarp
