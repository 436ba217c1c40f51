// The locally dominant order: insert a candidate as soon as no triangle near it has a worse one.
//
// THE PROBLEM. Greedy insertion (Garland & Heckbert 1995, Algorithm III) always inserts the worst sample of the whole
// raster. Once the scan of a triangle is fast, that order is the cost: the heap's next triangle lies anywhere, so that
// every insertion waits for memory, and one insertion at a time has no second thread.
//
// THE IDEA. Greedy insertion's gains over an arbitrary order are local: a peak must come before the samples on its
// flank, which it would make needless; a peak a kilometre away does not matter. So a candidate may be inserted when it
// is worse than the candidates of all triangles that its insertion would remove, and of those that border them:
//
//      ·───·───·        p: candidate of t
//     ╱ ╲ ╱ ╲ ╱ ╲       cavity: triangles whose circle holds p (they will go)
//    ·───·─t─·───·      ring: triangles beyond the cavity's sides
//     ╲ ╱ ╲p╱ ╲ ╱       p is inserted if no triangle of cavity and ring has a larger key
//      ·───·───·
//
// Keys (error, then the point of the candidate, lower first) are a total order that knows no ids, so nothing depends on
// where a triangle happens to be stored. From a triangle that is dominated we step to the worst one that dominates it,
// and so on uphill: keys grow along such a walk, so it ends, at a local maximum. Walks start from a stack of the
// triangles that wait; new ones are put on top, so that work stays in warm caches. Triangles that keep the bound are
// never on it.
//
// WHAT IT COSTS AND GAINS: bench/performance.md, "Order". Vertices within a few tenths of a per cent of greedy's on
// large rasters; the same promise, since the run ends in the same state: no triangle has a candidate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refine/tile_scanner.h"
#include "tin/tile_mesh.h"

namespace scarp {

struct DominantRun {
  std::uint64_t insertions = 0;
  std::uint64_t moves = 0;  ///< entries put on the stack
  bool finished = true;     ///< false: stopped at the most vertices allowed
};

/// Scans all triangles of the mesh, then inserts candidates until none is left, or until the mesh has `most` vertices.
/// `inserted`: where not null, the points in the order of insertion are added.
DominantRun refine_dominant(TileMesh& mesh, TileScanner& scanner, std::size_t most = SIZE_MAX,
                            std::vector<TilePoint>* inserted = nullptr);

}  // namespace scarp
