// Vertex attributes other than positions.
#pragma once

#include <cstdint>
#include <vector>

#include "base/point.h"
#include "metric/request.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::pieces {

/// Lattice points, with `steps` steps from one sample to the next.
struct LatticePoints {
  std::int32_t steps = 1;
  std::vector<Point> points;
};

/// True if add_attributes() adds any.
bool has_attributes(const HeightField& field, const metric::Request& options);

/// Adds the requested normals, the requested positions in the raster's image, and the field's channels. `field`: the
/// refined one; with a locked border, the given one. `at`: the vertices. Throws SourceFailure.
void add_attributes(const HeightField& field, const metric::Request& options, const LatticePoints& at, Mesh& mesh);

}  // namespace scarp::pieces
