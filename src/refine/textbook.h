// Algorithms I and II of the paper, as short as possible.
//
// Slow on purpose: they are the oracle for Refinement and for every faster engine. Same rule for ties, same arithmetic
// for an error (Plane::height_at), but no scan conversion, no queue, no caches that could go stale.
#pragma once

#include <cstddef>
#include <vector>

#include "grid/raster.h"
#include "tin/triangulation.h"

namespace scarp {

/// Algorithm I (section 4.1): before each insertion, test every sample against every triangle that contains it.
/// Inserts until no sample exceeds the threshold or `most` points are in. Returns the points in order of insertion.
std::vector<Point> insert_by_brute_force(const Raster& raster, Triangulation& tin, double threshold, std::size_t most);

/// Algorithm II (section 4.2): each triangle keeps its candidate; only triangles around the new vertex are tested
/// again; the worst candidate is found by scanning all of them.
std::vector<Point> insert_by_local_search(const Raster& raster, Triangulation& tin, double threshold, std::size_t most);

}  // namespace scarp
