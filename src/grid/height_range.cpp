#include <algorithm>
#include <cmath>

#include "scarp/height_field.h"

namespace scarp {

HeightRange height_range(const HeightField& field) {
  HeightRange range;
  if (field.samples == nullptr) return range;
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  for (std::size_t k = 0; k < count; ++k) {
    const float z = field.samples[k];
    if (!std::isfinite(z) || (field.nodata && z == *field.nodata)) continue;
    if (range.valid == 0) range.min = range.max = z;
    range.min = std::min(range.min, static_cast<double>(z));
    range.max = std::max(range.max, static_cast<double>(z));
    ++range.valid;
  }
  return range;
}

}  // namespace scarp
