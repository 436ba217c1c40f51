// Refinement tile by tile: the default engine for an error goal on plain heights.
//
// The raster is cut into tiles that share a row or a column of samples with their neighbours. A shared border is
// simplified first, on its own, to the same bound (border_chain.h); then each tile is refined alone in the locally
// dominant order (dominant.h): its samples lie in a buffer that fits the caches, its triangles are 32 bytes, its
// coordinates are 16 bits. Tiles know nothing of each other, so any number of threads works on them and the result
// depends on none; nor need more of the raster be in memory than the tiles at work. At the end the borders are set free
// (release.h): edges across them become Delaunay and the few triangles that changed are refined again.
//
//     ·───────┬───────┬──      ─── shared border: kept vertices are a function of the samples on it
//     │ tile  │ tile  │
//     ├───────┼───────┼──      Measured, fixed borders cost -3 to +1.5 %: docs/performance.md.
//     │ tile  │ tile  │
//
// Somebody else may finish rows of tiles: the mesh between two of the long borders is handed over with its samples,
// before they make room for the next row's. What is handed back, all strips' points in the same steps, must leave those
// two borders as they are.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "pieces/piece.h"
#include "refine/domain.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/strategy.h"

namespace scarp {

struct TiledOptions {
  double threshold = 0;
  int threads = 0;
  std::int32_t tile_side = 0;  ///< 0: chosen from the density of the mesh that the borders let expect
  /// Whether the answer may be nothing where the goal is so coarse that borders of tiles would cost vertices.
  bool may_decline = false;
  /// Fewer threads, smaller tiles where the samples come from a file, and at last a refusal keep a run within it.
  MemoryBudget memory = {};
  /// Called on the calling thread for one row after the other; what it says is final: release_seams() has no place
  /// behind it. EMPTY: rows stay as they are.
  std::function<Result<void>(Piece& strip)> finish_row = {};
  /// Of rows of samples, so many from the first on: whether finish_row makes their mesh from nothing. Tiles are not
  /// refined there. EMPTY: of none.
  std::function<bool(std::int32_t first, std::int32_t rows)> is_made_whole = {};
  std::uint64_t finish_bytes_per_vertex = 0;  ///< that it takes, of the row's, the row's mesh included
  std::uint64_t finish_bytes_per_sample = 0;  ///< that it takes beside a copy of the row's samples
  /// Told the share of tiles that are done and the vertices so far, on the calling thread; false stops with kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
};

struct Tiled {
  Domain domain;
  std::vector<HalfEdge> seams;  ///< edges between tiles, for release_seams()
  std::vector<float> heights;   ///< of the vertices, where rows were finished, or the field has a source for samples
  std::int32_t steps = 1;       ///< of the domain's points between two samples
  /// Of the vertices: 1 where who finished their row fixed them; EMPTY: none is.
  std::vector<std::uint8_t> fixed = {};
  Work work;
};

/// The side of tiles where they go by rows, from the memory there is, and the rows of samples that rows of tiles of
/// such a side share, ascending.
std::int32_t streamed_side(const HeightField& field, const TiledOptions& options);
std::vector<std::int32_t> shared_rows(const HeightField& field, std::int32_t side);

/// Where the field's source is not in memory, or rows are finished, one row of tiles after the other is read and
/// refined.
///
/// Every sample of the surface lies within `threshold` of the triangulation, if finish_row() keeps it. Nothing where
/// heights span magnitudes beyond exact arithmetic, and where it may decline. Fails as the field's source does; with
/// kInput if no cell is surface or the triangles are too many; with kUsage if the memory is too little; kCancelled.
Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options);

}  // namespace scarp
