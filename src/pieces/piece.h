// A piece: a window of the raster with its mesh. The passes (passes.h) work on pieces.
//
//     in memory      one piece: the whole raster, nothing shared
//     streamed       a strip after the other: the upper and the lower row of samples shared with the neighbours
//
// A piece never reads beyond its samples and one more row around them. The vertices on a shared row are a function of
// that row's samples and tolerances only. So both neighbours find the same vertices, and neither adds any.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

struct Piece {
  Raster samples;                             ///< NaN is nodata
  std::int32_t first = 0;                     ///< first of its rows of samples, in the raster
  Triangulation tin;                          ///< in the piece's own coordinates
  bool has_above = false, has_below = false;  ///< neighbours, which have the vertices on their shared row too
  Raster around = {};                         ///< `samples`, and a row more on each side where there is a neighbour
  VertexLattice lattice = {};                 ///< lattice of the vertices of `tin`
  /// The aim of refinement, by sample; EMPTY: the run's threshold everywhere.
  std::span<const float> aims = {};
  /// True once each sample keeps the aim of refinement.
  bool is_refined = false;
  /// True if any surface remains after the cutline.
  bool has_surface = true;
  /// Called from time to time, with the finished share of the pass and the largest error left. Fails if memory does not
  /// hold so many vertices, and with kCancelled. EMPTY: never called.
  std::function<Result<void>(std::uint64_t vertices, double share, double error)> check = {};
};

}  // namespace scarp
