// A window of a height field's samples, in memory or from a source.
#pragma once

#include <cstddef>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// Copies cols × rows samples from (col, row) on to `out`, `stride` floats a row. Missing samples (NaN, infinities,
/// nodata) become NaN. Fails as the field's source does. REQUIRES: the window lies in the field.
Result<void> read_window(const HeightField& field, int col, int row, int cols, int rows, float* out,
                         std::ptrdiff_t stride);

}  // namespace scarp::grid
