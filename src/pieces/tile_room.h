// The memory of tiles that are refined concurrently.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/memory_budget.h"
#include "base/parallel.h"

namespace scarp::pieces {

/// Divides the memory that the mesh does not use among the active tiles. The share of a new tile depends on the others.
/// A single tile gets all free memory.
class TileRoom {
 public:
  /// `base`: bytes that any mesh needs. `vertices`: of the mesh so far. `tiles`: the maximum at a time.
  TileRoom(const MemoryBudget& memory, std::uint64_t base, std::uint64_t vertices, int tiles);

  /// The maximum number of vertices of a tile that begins now; unlimited without a memory limit.
  std::size_t begin();
  /// Reports that a tile finished with `vertices` and now waits. `most`: the result of begin().
  void end(std::size_t most, std::size_t vertices);
  /// Moves a waiting tile's vertices to the mesh.
  void commit(std::size_t vertices);

  /// Bytes per vertex of an active tile.
  static std::uint64_t bytes_per_vertex(const MemoryBudget& memory);

 private:
  struct State {
    std::uint64_t mesh = 0, tiles = 0;  ///< bytes
  };

  const MemoryBudget memory_;
  std::uint64_t room_, tiles_;
  Shared<State> state_;
};

}  // namespace scarp::pieces
