#include "grid/window.h"

#include <cmath>
#include <limits>

namespace scarp::grid {

Result<void> read_window(const HeightField& field, int col, int row, int cols, int rows, float* out,
                         std::ptrdiff_t stride) {
  if (field.samples == nullptr) return field.source->read(col, row, cols, rows, out, stride);
  // NaN equals nothing, so without a nodata value no sample is replaced.
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const float nodata = field.nodata.value_or(kNan);
  for (int y = 0; y < rows; ++y) {
    const float* from = field.samples + static_cast<std::ptrdiff_t>(row + y) * field.cols + col;
    float* to = out + y * stride;
    for (int x = 0; x < cols; ++x)
      to[x] = std::abs(from[x]) <= std::numeric_limits<float>::max() && from[x] != nodata ? from[x] : kNan;
  }
  return {};
}

}  // namespace scarp::grid
