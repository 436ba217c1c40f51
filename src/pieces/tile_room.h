// The memory of tiles that are refined side by side.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/memory_budget.h"
#include "base/parallel.h"

namespace scarp {

/// Gives each tile that begins a share of the room that the mesh so far leaves, so that none outgrows it together with
/// its neighbours. What a tile gets depends on the others at work, unless it is alone: then it has all of the room.
class TileRoom {
 public:
  /// `base`: bytes taken whatever the mesh. `vertices`: of the mesh so far. `tiles`: side by side, at most.
  TileRoom(const MemoryBudget& memory, std::uint64_t base, std::uint64_t vertices, int tiles);

  /// The most vertices that a tile may have that begins now; none without a limit.
  std::size_t begin();
  /// It has so many of them, and waits.
  void end(std::size_t most, std::size_t vertices);
  /// One that waited has become part of the mesh.
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
