// The memory of tiles that are refined concurrently.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/memory_budget.h"
#include "base/parallel.h"

namespace scarp {

/// Divides the memory that the mesh does not use among the tiles at work. The share of a new tile depends on the
/// others. A tile alone gets all of the free memory.
class TileRoom {
 public:
  /// `base`: bytes that any mesh needs. `vertices`: of the mesh so far. `tiles`: the maximum at a time.
  TileRoom(const MemoryBudget& memory, std::uint64_t base, std::uint64_t vertices, int tiles);

  /// The maximum number of vertices of a tile that begins now; unlimited without a memory limit.
  std::size_t begin();
  /// Reports a tile finished with so many vertices, which now waits. `most`: what begin() returned.
  void end(std::size_t most, std::size_t vertices);
  /// Moves a waiting tile's vertices to the mesh.
  void commit(std::size_t vertices);

  /// Bytes a vertex of a tile at work.
  static std::uint64_t bytes_per_vertex(const MemoryBudget& memory);

 private:
  struct State {
    std::uint64_t mesh = 0, tiles = 0;  ///< bytes
  };

  const MemoryBudget memory_;
  std::uint64_t room_, tiles_;
  Shared<State> state_;
};

}  // namespace scarp
