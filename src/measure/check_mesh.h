// Validation of meshes before they are judged.
#pragma once

#include <cmath>

#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// Coordinates up to this size can be multiplied three times without overflow.
inline bool is_in_reach(double coordinate) { return std::abs(coordinate) <= 1e100; }

/// Fails with kInput unless the mesh has triangles, and all their vertices exist and satisfy is_in_reach().
Result<void> check_mesh(const Mesh& mesh);

}  // namespace scarp::judge
