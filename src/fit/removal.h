// Exact removal: removes vertices from a mesh while every sample stays within the bound.
//
// A vertex can be removed if its ring can be triangulated with every sample of every triangle within the threshold
// (ring_search.h). No other vertex moves: the remaining ones are samples with their own heights, as after insertion.
// Vertices are removed greedily, by price:
//
//   price of v = energy of the best triangles of its ring - energy of the triangles around v,
//   energy of a triangle = Σ (error / threshold)² over its samples:
//
// so the error that the bound allows is used where it saves most. The cheapest vertex is removed first. Prices around
// it become stale, but are updated only at the front of the queue (lazy_queue.h). Refused vertices wait until the queue
// is empty, when most changes around them have happened. So no single vertex of the final mesh can be removed. The pass
// removes 45 to 50 % of the vertices of greedy insertion.
//
// Vertices of equal price are removed in the order of the patch, so the result depends on the patch only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

struct RemovalCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< number of rings examined
};

/// Removes vertices until at most `most` triangles remain or no vertex can be removed. Calls is_time_up(), if not
/// empty, before each vertex. `settled`: by node, 1 if it certainly cannot be removed; updated if no vertex can be
/// removed. REQUIRES: every triangle of the patch is within the threshold; settled.size() == patch.node_count().
RemovalCounts remove_vertices(Patch& patch, const TriangleError& error, const ShapeRule& shape, std::size_t most,
                              const std::function<bool()>& is_time_up, std::vector<std::uint8_t>& settled);

}  // namespace scarp::fit
