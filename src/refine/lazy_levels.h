// The lazy order: by levels of error, highest first, and a triangle is scanned when its turn comes.
//
// THE PROBLEM. In the dominant order (dominant.h) every insertion scans the whole fan around the new vertex, some six
// triangles, of which two survive. The other four are gone before anybody asks for their candidates; scans are the
// cost of a fine mesh.
//
// THE IDEA. A new triangle is not scanned. It gets an estimated error
//
//     error of the candidate just inserted × (its area / area of the triangle that held the candidate)^power
//
// and waits in the bucket of that error, 8 buckets an octave, first in, first out. When its turn comes it is scanned;
// most are gone by then, or clean. If the true error lies more than a quarter octave below the level, the triangle
// waits once more, in its true bucket; else its candidate is inserted. Estimates at or below the threshold, half of
// all, do not wait in a bucket: once the buckets are empty, a sweep over all triangles scans the others.
//
// An estimate is no bound and need not be one: a wrong one changes the order alone. The promise is that of the dominant
// order, since the run ends in the same state: every triangle was scanned and none has a candidate.
//
// WHERE IT IS USED (tile_order.h): on rough terrain, where the area predicts about as much as a scan would: there it
// needs fewer vertices as well. On smooth terrain the dominant order needs fewer. WHAT IT GAINS: bench/performance.md,
// "Order".
#pragma once

#include <cstddef>

#include "refine/dominant.h"
#include "refine/tile_scanner.h"
#include "tin/tile_mesh.h"

namespace scarp {

/// How an estimated error follows the area.
enum class AreaPower {
  kHalf,  ///< by its square root: an error grows like a length
  kOne,
};

/// Scans all triangles of the mesh, then inserts candidates until none is left, or until the mesh has `most` vertices.
/// Work done: insertions and entries put into buckets. Keys of a run that stopped may be estimates.
DominantRun refine_lazily(TileMesh& mesh, TileScanner& scanner, AreaPower power, std::size_t most = SIZE_MAX);

}  // namespace scarp
