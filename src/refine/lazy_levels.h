// The lazy order inserts by levels of error, the highest first. A triangle is scanned only when its turn comes.
//
// THE PROBLEM. In the dominant order (dominant.h), every insertion scans the whole fan around the new vertex, some six
// triangles. Four of them are removed before their candidates are used; scans dominate the cost of a fine mesh.
//
// THE IDEA. A new triangle is not scanned. It gets an estimated error
//
//     error of the candidate just inserted × (its area / area of the triangle that held the candidate)^power
//
// and waits in the bucket of that error, 8 buckets per octave, first in, first out. It is scanned in its turn; most
// triangles are removed or clean by then. If the true error is more than a quarter octave below the level, the triangle
// waits again, in its true bucket; else its candidate is inserted. Triangles with estimates at or below the threshold,
// half of all, do not wait in a bucket. Once the buckets are empty, a sweep over all triangles scans them.
//
// An estimate need not be a bound: a wrong estimate changes only the order. The guarantee is that of the dominant
// order, since the run ends in the same state: every triangle was scanned and none has a candidate.
//
// WHERE IT IS USED (tile_order.h): on rough terrain, where the area predicts the error about as well as a scan. There
// it also needs fewer vertices; on smooth terrain, the dominant order needs fewer. WHAT IT GAINS: bench/performance.md,
// "Order".
#pragma once

#include <cstddef>

#include "refine/dominant.h"
#include "refine/tile_scanner.h"
#include "tin/tile_mesh.h"

namespace scarp::refine {

/// The power of the area in an estimated error.
enum class AreaPower {
  kHalf,  ///< square root: an error grows like a length
  kOne,
};

/// Scans all triangles of the mesh, then inserts candidates until none is left, or until the mesh has `most` vertices.
/// Counts insertions and entries put into buckets as work. After a run that stopped, keys may be estimates.
DominantRun refine_lazily(tin::TileMesh& mesh, TileScanner& scanner, AreaPower power, std::size_t most = SIZE_MAX);

}  // namespace scarp::refine
