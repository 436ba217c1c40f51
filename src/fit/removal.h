// Exact removal: removes vertices from a mesh while every sample stays within the bound.
//
// A vertex may go if the ring around it can be triangulated so that every sample of every triangle keeps the threshold
// (ring_search.h). No other vertex moves: the remaining ones are samples with their own heights, as after insertion.
// Vertices are removed greedily, by price:
//
//   price of v = energy of the best triangles of its ring - energy of the triangles around v,
//   energy of a triangle = Σ (error / threshold)² over its samples:
//
// so the errors that the bound allows are spent where they save most. The cheapest goes first. Prices around it become
// stale, but are updated only when their turn comes (a lazy queue). Vertices that could not go wait until the end, when
// most changes around them have happened. So the pass ends with a mesh in which no vertex can go alone. It removes 45
// to 50 % of what greedy insertion left.
//
// Vertices of equal price go in the order of the patch, so the outcome is a function of the patch alone.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

struct RemovalCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< number of rings examined
};

/// Removes vertices until none can go. `settled`: by node, 1 where it is known that it cannot; brought up to date,
/// unless the time was up before the end: it is asked before each vertex, if there is someone to ask.
/// REQUIRES: every triangle of the patch keeps the threshold; settled.size() == patch.node_count().
RemovalCounts remove_vertices(Patch& patch, const TriangleError& error, const ShapeRule& shape,
                              const std::function<bool()>& is_time_up, std::vector<std::uint8_t>& settled);

}  // namespace scarp
