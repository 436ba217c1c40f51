// Which vertices are removed with repair, and in which order.
//
// As in removal (removal.h) the cheapest goes first, its price the rise of energy of the best triangulation of its
// ring, but with the slack of repair and with Σ t⁸, which weighs what is near the bound. A successful repair makes the
// prices of all corners of changed triangles stale. Before, one sweep of flips and steps over the whole patch, under
// the bound itself, puts vertices and edges where removal wants them: without it a second round would find what the
// first left.
//
// On Fuji and Crater Lake at 2 to 0.5 % of the relief 2 to 4 % more triangles stay without the sweep, 2 to 5 % more
// after one round than after two; a third takes 1 to 2 % more away.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "fit/patch.h"
#include "fit/repair.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

struct RepairOptions {
  RepairDepth depth = {};
  MoveRules rules = {};
  std::uint32_t shake = 0;  ///< other than 0: vertices are shaken first, by dice that this is the seed of
  int polishes = 0;         ///< sweeps that level the heights of free vertices at the end
  std::span<const std::uint8_t> wanted = {};  ///< by node, 1 for those to look at first; EMPTY: all
  std::function<bool()> is_time_up = {};      ///< asked before each vertex; true ends the rest but for polishing
};

struct RepairCounts {
  std::uint64_t removed = 0;  ///< vertices
  std::uint64_t tried = 0;    ///< removals that were begun
};

/// Removes vertices of the patch.
/// REQUIRES: every triangle of the patch keeps the threshold of `error`, which has energies.
RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options);

}  // namespace scarp
