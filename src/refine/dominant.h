// The locally dominant order: a candidate is inserted as soon as no triangle near it has a worse one.
//
// THE PROBLEM. Greedy insertion (Garland & Heckbert 1995, Algorithm III) always inserts the worst sample of the whole
// raster. Once the scan of a triangle is fast, this order dominates the cost. The heap's next triangle may lie
// anywhere, so every insertion waits for memory, and one insertion at a time cannot use a second thread.
//
// THE IDEA. Greedy insertion's advantage over an arbitrary order is local. A peak must precede the samples on its
// flank, which it makes unnecessary; a peak a kilometre away does not matter. So a candidate may be inserted when it is
// worse than the candidates of all triangles that its insertion removes, and of the triangles next to them:
//
//      ·───·───·        p: candidate of t
//     ╱ ╲ ╱ ╲ ╱ ╲       cavity: triangles whose circle holds p (they will go)
//    ·───·─t─·───·      ring: triangles beyond the cavity's sides
//     ╲ ╱ ╲p╱ ╲ ╱       p is inserted if no triangle of cavity and ring has a larger key
//      ·───·───·
//
// Keys (error, then the point of the candidate, lower first) are a total order without ids, so nothing depends on where
// a triangle is stored. From a dominated triangle, a walk steps to the worst triangle that dominates it, and continues
// there. Keys grow along a walk, so it ends at a local maximum. Walks start from a stack of waiting triangles. New
// triangles are pushed on top, so that work stays in warm caches. Triangles that satisfy the bound are never on the
// stack.
//
// WHAT IT COSTS AND GAINS: bench/performance.md, "Order". On large rasters, the number of vertices is within a few
// tenths of a per cent of greedy's. The guarantee is the same, since the run ends in the same state: no triangle has a
// candidate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refine/tile_scanner.h"
#include "tin/tile_mesh.h"

namespace scarp::refine {

struct DominantRun {
  std::uint64_t insertions = 0;
  std::uint64_t moves = 0;  ///< entries pushed on the stack
  bool finished = true;     ///< false: stopped at the vertex limit
};

/// Scans all triangles of the mesh, then inserts candidates until none is left, or until the mesh has `most` vertices.
/// Appends the inserted points to `inserted`, in order, unless it is null.
DominantRun refine_dominant(tin::TileMesh& mesh, TileScanner& scanner, std::size_t most = SIZE_MAX,
                            std::vector<geom::TilePoint>* inserted = nullptr);

}  // namespace scarp::refine
