// Normals of the full-resolution surface.
#pragma once

#include <cstdint>
#include <vector>

#include "grid/bands.h"
#include "pieces/vertex_attributes.h"
#include "scarp/height_field.h"
#include "scarp/options.h"

namespace scarp {

/// Unit normals of the full-resolution surface, in the frame: at samples central differences, one-sided next to nodata
/// and borders; between samples the bilinear mean of the valid samples around; 3 values a point, z > 0. Vertical where
/// no sample around is valid. On the sides of a locked border a function of what both neighbours know; see Border.
/// Streamed samples are read once, from the top. Throws SourceFailure.
std::vector<float> sample_normals(const HeightField& field, const LatticePoints& at, const Border& border = {});

/// Those of the samples of row y, in [begin, end) of a range that reaches a row beyond; at nodata NaN.
std::vector<float> row_normals(const RowRange& rows, const HeightField& field, std::int32_t y);

}  // namespace scarp
