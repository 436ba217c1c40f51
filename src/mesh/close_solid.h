// The common part of add_base() and build_solid(): closing a terrain to a solid.
#pragma once

#include "scarp/mesh.h"

namespace scarp::mesh {

/// True if a base at z = `base` is below every vertex, also in float32 offsets.
bool is_below_all(const Mesh& mesh, double base);

/// Adds walls and base. Duplicates vertices where parts meet in a single point. `step_back`: all duplicates except one
/// move into their part by a few units in the last place of float32. REQUIRES: as add_base(); is_below_all().
void close_solid(Mesh& mesh, double base, bool step_back);

}  // namespace scarp::mesh
