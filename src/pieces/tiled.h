// Refinement tile by tile: the default engine for an error goal on plain heights.
//
// The raster is cut into tiles that share a row or a column of samples with their neighbours. A shared border is
// simplified first, on its own, to the same bound (border_chain.h); then each tile is refined alone in the locally
// dominant order (dominant.h): its samples lie in a buffer that fits the caches, its triangles are 32 bytes, its
// coordinates are 16 bits. Tiles are independent of each other, so any number of threads gives the same result. Only
// the tiles at work need their samples in memory. At the end the borders are freed (release.h): edges across them
// become Delaunay and the few changed triangles are refined again.
//
//     ·───────┬───────┬──      ─── shared border: kept vertices are a function of the samples on it
//     │ tile  │ tile  │
//     ├───────┼───────┼──      Measured, fixed borders cost -3 to +1.5 %: bench/performance.md.
//     │ tile  │ tile  │
//
// A callback may post-process each strip (a row of tiles). It receives the mesh between two of the long borders with
// its samples, before those of the next strip replace them. It must return all strips' points in the same steps, and
// must not change the two borders.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "pieces/piece.h"
#include "refine/domain.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp {

struct TiledOptions {
  double threshold = 0;
  int threads = 0;
  std::int32_t tile_side = 0;  ///< 0: chosen from the density of the mesh expected from the borders
  /// True if refine_tiled() may return nothing if the goal is so coarse that borders of tiles would cost vertices.
  bool may_decline = false;
  /// The limit is kept by fewer threads, by smaller tiles if the samples come from a file, and finally by refusal.
  MemoryBudget memory = {};
  /// Called on the calling thread for each strip in turn. Its result is final: release_seams() must not follow. EMPTY:
  /// strips stay as they are.
  std::function<Result<void>(Piece& strip)> finish_strip = {};
  /// True if finish_strip makes the whole mesh of `rows` rows of samples from `first` on. Tiles are not refined there.
  /// EMPTY: of none.
  std::function<bool(std::int32_t first, std::int32_t rows)> is_made_whole = {};
  std::uint64_t finish_bytes_per_vertex = 0;  ///< bytes of finishing, for each vertex of the strip, the strip's mesh
                                              ///< included
  std::uint64_t finish_bytes_per_sample = 0;  ///< bytes of finishing in addition to a copy of the strip's samples
  /// Receives the share of finished tiles and the vertices so far, on the calling thread; false stops with kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
};

struct Tiled {
  DomainMesh domain;
  std::vector<HalfEdge> seams;  ///< edges between tiles, for release_seams()
  std::vector<float> heights;   ///< heights of the vertices, where strips were finished, or the field has a source for
                                ///< samples
  std::int32_t steps = 1;       ///< number of steps of the domain's points between two samples
  /// For each vertex: 1 if fixed while its strip was finished; EMPTY: none is.
  std::vector<std::uint8_t> fixed = {};
  Work work;
};

/// The side of tiles that are processed strip by strip, from the available memory; and the rows of samples that strips
/// of this side share, ascending.
std::int32_t streamed_side(const HeightField& field, const TiledOptions& options);
std::vector<std::int32_t> shared_rows(const HeightField& field, std::int32_t side);

/// If the field's source is not in memory, or strips are finished, one strip after the other is read and
/// refined.
///
/// Every sample of the surface lies within `threshold` of the triangulation, if finish_strip() keeps it. Nothing where
/// heights span magnitudes beyond exact arithmetic, and where it may decline. Fails as the field's source does; with
/// kInput if no cell is surface or the triangles are too many; with kUsage if the memory is too little; kCancelled.
Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options);

/// The same of a raster in memory as one tile, whose border is locked: it begins with these vertices on its sides,
/// where no other comes, and these inside. Nothing also where it has nodata or is too large for one tile. Reads the
/// options' threshold and memory.
Result<std::optional<Tiled>> refine_alone(const Raster& raster, std::span<const Point> on_sides,
                                          std::span<const Point> inside, const TiledOptions& options);

}  // namespace scarp
