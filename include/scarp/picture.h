// Pictures of height fields, meshes and errors.
#pragma once

#include <span>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/mesh.h"

namespace scarp {

/// Hillshade of the field with the mesh's edges over it, at most `max_side` pixels wide or high. Void samples are
/// white.
Picture draw_preview(const HeightField& field, const Mesh& mesh, int max_side = 1400);

/// Map of signed errors (row-major, cols·rows, NaN = void or uncovered) in diverging colours, blue below and red above
/// the samples, with a scale bar from −limit to +limit in z units. `limit` <= 0: the largest |error|.
Picture draw_error_map(std::span<const float> errors, int cols, int rows, double limit = 0, int max_side = 1400);

}  // namespace scarp
