// Meshes that can be judged at all.
#pragma once

#include <cmath>

#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// Coordinates of this size can be multiplied three times before they are infinite.
inline bool is_in_reach(double coordinate) { return std::abs(coordinate) <= 1e100; }

/// kInput unless the mesh has triangles, all of vertices that it has, at finite coordinates in reach.
Result<void> check_mesh(const Mesh& mesh);

}  // namespace scarp::judge
