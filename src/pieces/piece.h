// A piece: a window of the raster with its mesh, on which the passes (passes.h) work.
//
//     in memory      one piece: the whole raster, nothing shared
//     streamed       one strip at a time, which shares its upper and lower rows of samples with its neighbours
//
// A piece reads only its samples and one more row around them. The vertices on a shared row depend only on that row's
// samples and tolerances. Both neighbours find the same vertices there, and neither adds others.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp::pieces {

struct Piece {
  grid::Raster samples;                       ///< NaN is nodata
  std::int32_t first = 0;                     ///< row of its first samples in the raster
  tin::Triangulation tin;                     ///< in the piece's own coordinates
  bool has_above = false, has_below = false;  ///< a neighbour there has the same vertices on the shared row
  grid::Raster around = {};                   ///< `samples`, and one more row towards each neighbour
  grid::VertexLattice lattice = {};           ///< lattice of the vertices of `tin`
  /// The aim of refinement by sample; EMPTY: the run's threshold everywhere.
  std::span<const float> aims = {};
  /// True if each sample satisfies the aim of refinement.
  bool is_refined = false;
  /// True if any surface remains after the cutline.
  bool has_surface = true;
  /// Called at intervals with the finished share of the pass and the largest remaining error. Fails if memory does not
  /// suffice for the vertices, and with kCancelled. EMPTY: never called.
  std::function<Result<void>(std::uint64_t vertices, double share, double error)> check = {};
};

}  // namespace scarp::pieces
