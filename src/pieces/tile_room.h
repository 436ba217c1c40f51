// The memory of tiles that are refined side by side.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/memory_budget.h"
#include "base/parallel.h"

namespace scarp {

/// Gives each new tile a share of the memory that the mesh does not use, so that all tiles at work fit together. The
/// share depends on the other tiles at work. A tile alone gets all of the free memory.
class TileRoom {
 public:
  /// `base`: bytes that any mesh needs. `vertices`: those of the mesh so far. `tiles`: the most that are made at a
  /// time.
  TileRoom(const MemoryBudget& memory, std::uint64_t base, std::uint64_t vertices, int tiles);

  /// The most vertices of a tile that begins now; no limit without a memory limit.
  std::size_t begin();
  /// The tile is finished with so many vertices, and waits.
  void end(std::size_t most, std::size_t vertices);
  /// A waiting tile has become part of the mesh.
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
