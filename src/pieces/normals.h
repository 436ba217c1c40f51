// Normals of the full-resolution surface.
#pragma once

#include <cstdint>
#include <vector>

#include "grid/bands.h"
#include "pieces/vertex_attributes.h"
#include "scarp/height_field.h"
#include "scarp/options.h"

namespace scarp::pieces {

/// Unit normals of the full-resolution surface in the frame, 3 values per point, z > 0. At samples: from central
/// differences, or from one-sided differences next to nodata and borders. Between samples: the bilinear mean of the
/// normals of the valid samples around; vertical if none is valid. On a locked border, normals depend only on data that
/// both neighbours have; see Border. Streamed samples are read once, from the top. Throws SourceFailure.
std::vector<float> sample_normals(const HeightField& field, const LatticePoints& at, const Border& border = {});

/// Normals of the samples of row y in [begin, end); NaN at nodata. `rows` also covers the adjacent rows.
std::vector<float> row_normals(const grid::RowRange& rows, const HeightField& field, std::int32_t y);

}  // namespace scarp::pieces
