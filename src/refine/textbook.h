// Algorithms I and II of the paper, as short as possible.
//
// They are slow on purpose: the oracle for Refinement and every faster engine. They use the same rule for ties and the
// same arithmetic for an error (Plane::height_at), but no scan conversion, queue or caches.
#pragma once

#include <cstddef>
#include <vector>

#include "grid/raster.h"
#include "tin/triangulation.h"

namespace scarp::refine {

/// Algorithm I (section 4.1): before each insertion, test every sample against every triangle that contains it. Inserts
/// until no sample exceeds the threshold or `most` points are inserted. Returns the points in order of insertion.
std::vector<Point> insert_by_brute_force(const grid::Raster& raster, tin::Triangulation& tin, double threshold,
                                         std::size_t most);

/// Algorithm II (section 4.2): each triangle stores its candidate. Only triangles around the new vertex are tested
/// again. A scan of all triangles finds the worst candidate.
std::vector<Point> insert_by_local_search(const grid::Raster& raster, tin::Triangulation& tin, double threshold,
                                          std::size_t most);

}  // namespace scarp::refine
