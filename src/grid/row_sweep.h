// The rows of a raster from the top down, some of them at a time, in memory or from a source.
#pragma once

#include <cstdint>
#include <functional>

#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// Rows [begin, end) of a raster, and up to a given number more above and below.
struct RowStrip {
  Raster samples;          ///< NaN where nodata
  std::int32_t first = 0;  ///< of its rows, in the raster
  std::int32_t begin = 0, end = 0;

  const float* row(std::int32_t y) const { return samples.row(y - first); }
};

/// Calls visit(strip) from the top down; each row lies in [begin, end) of one strip, which has `reach` rows above and
/// below those, as far as the raster does. What is in memory is one strip. What is not is read once; memory: 4 bytes a
/// sample of 64 + 2 · reach rows. Fails as the field does, and as visit() does.
Result<void> sweep_rows(const HeightField& field, std::int32_t reach,
                        const std::function<Result<void>(const RowStrip& strip)>& visit);

/// Bytes of such a strip; 0 where the samples are in memory.
std::uint64_t sweep_bytes(const HeightField& field, std::int32_t reach);

}  // namespace scarp
