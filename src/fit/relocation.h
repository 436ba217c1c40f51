// Relocation: one step of each vertex to a better sample, between two removals.
//
// Removal ends where no vertex can go alone. A step of each vertex (vertex_step.h), led by the energy Σ t⁸ and within
// the bound, moves errors away from where they are near it, and the next removal finds what they held back.
//
// Over the 44 cases of bench/quality/efforts.csv with less than a quarter of the full grid, but for the largest raster,
// 0.522 of greedy's triangles are left instead of 0.562, in 1.28 times the time of all of simplify(). Steps led by Σ t²
// keep 0.529; a sweep of flips before gains nothing; a second step and removal keep 2 % less, for half as much again.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

/// Moves vertices within the bound. `settled`: by node, 0 afterwards where something around has changed. Errors and
/// energies of triangles are not known afterwards. REQUIRES: every triangle of the patch keeps the threshold of
/// `error`, which has energies; settled.size() == patch.node_count().
void relocate_vertices(Patch& patch, const TriangleError& error, const MoveRules& rules,
                       std::vector<std::uint8_t>& settled);

}  // namespace scarp
