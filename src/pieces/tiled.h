// Refinement tile by tile: the default engine for an error goal on plain heights.
//
// The raster is cut into tiles that share a row or a column of samples with their neighbours. Each shared border is
// first simplified separately to the same bound (border_chain.h). Then each tile is refined separately in the locally
// dominant order (dominant.h). Its samples fit the caches; a triangle has 32 bytes and a coordinate 16 bits. Tiles are
// independent, so the result does not depend on threads, and only active tiles need their samples in memory. At the end
// the borders are released (release.h): edges across them become Delaunay and the few changed triangles are refined
// again.
//
//     ·───────┬───────┬──      ─── shared border: its vertices depend only on its samples
//     │ tile  │ tile  │
//     ├───────┼───────┼──          Measured cost of fixed borders, -3 to +1.5 %: bench/performance.md.
//     │ tile  │ tile  │
//
// A callback may post-process each strip (a row of tiles). It receives the mesh between two long borders with its
// samples, before the next strip replaces them. It must use the same lattice steps for all strips and must not change
// the two borders.
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

namespace scarp::pieces {

struct TiledOptions {
  double threshold = 0;
  int threads = 0;
  std::int32_t tile_side = 0;  ///< 0: chosen by the mesh density that the borders suggest
  /// True if refine_tiled() may return none for a goal so coarse that tile borders would cost vertices.
  bool may_decline = false;
  /// To satisfy the limit, uses fewer threads, then smaller tiles if samples are in a file; fails if that does not
  /// suffice.
  MemoryBudget memory = {};
  /// Called for each strip in turn on the calling thread. Its result is final: release_seams() must not follow. EMPTY:
  /// strips are not changed.
  std::function<Result<void>(Piece& strip)> finish_strip = {};
  /// True if finish_strip makes the whole mesh of `rows` rows of samples from `first` on; tiles are not refined there.
  /// EMPTY: false.
  std::function<bool(std::int32_t first, std::int32_t rows)> is_made_whole = {};
  std::uint64_t finish_bytes_per_vertex = 0;  ///< bytes that finishing needs per vertex of the strip, its mesh included
  std::uint64_t finish_bytes_per_sample = 0;  ///< bytes that finishing needs per sample, plus a copy of the strip's
                                              ///< samples
  /// Receives the share of finished tiles and the vertices so far, on the calling thread; false stops with kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
};

struct Tiled {
  refine::DomainMesh domain;
  std::vector<tin::HalfEdge> seams;  ///< edges between tiles, for release_seams()
  std::vector<float> heights;        ///< heights of the vertices, if strips were finished or the field has a source
  std::int32_t steps = 1;            ///< lattice steps between two samples
  /// For each vertex: 1 if fixed while its strip was finished; EMPTY: none is.
  std::vector<std::uint8_t> fixed = {};
  Work work;
};

/// The side of tiles for processing strip by strip, from the available memory; and the rows that such strips share, in
/// ascending order.
std::int32_t streamed_side(const HeightField& field, const TiledOptions& options);
std::vector<std::int32_t> shared_rows(const HeightField& field, std::int32_t side);

/// Reads and refines one strip at a time if the samples are not in memory or strips are finished. Every sample of the
/// surface lies within `threshold` of the triangulation, if finish_strip() preserves this. Returns none if magnitudes
/// of heights differ too much for exact arithmetic, or if it declines. Fails if the field's source fails; with kInput
/// if there are no surface cells or too many triangles; with kUsage for too little memory; and with kCancelled.
Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options);

/// Refines a raster in memory as one tile with a locked border: starts with the given vertices and adds none on the
/// sides. Also returns none for nodata or a raster too large for one tile. Uses the options' threshold and memory.
Result<std::optional<Tiled>> refine_alone(const grid::Raster& raster, std::span<const Point> on_sides,
                                          std::span<const Point> inside, const TiledOptions& options);

}  // namespace scarp::pieces
