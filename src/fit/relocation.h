// Relocation: one step of each vertex to a better sample, between two removals.
//
// Removal ends when no single vertex can be removed. A step of each vertex (vertex_step.h), which lowers the energy Σ
// t⁸ within the bound, reduces the errors near the bound. So the next removal can remove more vertices.
//
// Over the 44 cases of bench/quality/efforts.csv with less than a quarter of the full grid, except the largest raster,
// 0.522 of greedy's triangles remain instead of 0.562, in 1.28 times the time of the whole simplify(). With steps by Σ
// t², 0.529 remain. An earlier sweep of flips gains nothing. A second step and removal leave 2 % fewer triangles, for
// half as much time again. Steps to places between samples instead, with heights of their own (normal effort with free
// vertices), leave 0.967 times the triangles on 16 cases of terrain, and 0.83 times on the fields of
// bench/quality/optimum.cpp, in 1.15 times the time.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

/// Moves vertices within the bound. `settled`: by node, set to 0 where something around has changed. Errors and
/// energies of triangles are unknown afterwards. REQUIRES: every triangle of the patch is within the threshold of
/// `error`, which has energies; settled.size() == patch.node_count().
void relocate_vertices(Patch& patch, const TriangleError& error, const MoveRules& rules,
                       std::vector<std::uint8_t>& settled);

}  // namespace scarp::fit
