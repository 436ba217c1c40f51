#include "pieces/tile_room.h"

#include <algorithm>
#include <limits>

namespace scarp::pieces {

namespace {

constexpr std::uint64_t kPiece = 62;       ///< bytes per vertex of a TilePiece and its heights
constexpr std::uint64_t kWorkbench = 128;  ///< bytes of the active mesh, the stack of triangles, and the numbers of
                                           ///< vertices

}  // namespace

std::uint64_t TileRoom::bytes_per_vertex(const MemoryBudget& memory) {
  return std::max(kWorkbench + kPiece, memory.per_vertex);
}

TileRoom::TileRoom(const MemoryBudget& memory, std::uint64_t base, std::uint64_t vertices, int tiles)
    : memory_(memory), room_(std::max(memory.rest(), base) - base), tiles_(static_cast<std::uint64_t>(tiles)) {
  state_.with([&](State& state) { state.mesh = vertices * memory.per_vertex; });
}

std::size_t TileRoom::begin() {
  if (!memory_.is_limited()) return std::numeric_limits<std::size_t>::max();
  return state_.with([this](State& state) {
    const std::uint64_t whole = std::max(room_, state.mesh) - state.mesh;
    const std::uint64_t left = std::max(whole, state.tiles) - state.tiles;
    const std::uint64_t most = std::min(whole / tiles_, left) / bytes_per_vertex(memory_);
    state.tiles += most * bytes_per_vertex(memory_);
    return static_cast<std::size_t>(most);
  });
}

void TileRoom::end(std::size_t most, std::size_t vertices) {
  if (!memory_.is_limited()) return;
  state_.with([&](State& state) { state.tiles += vertices * kPiece - most * bytes_per_vertex(memory_); });
}

void TileRoom::commit(std::size_t vertices) {
  if (!memory_.is_limited()) return;
  state_.with([&](State& state) {
    state.tiles -= vertices * kPiece;
    state.mesh += vertices * memory_.per_vertex;
  });
}

}  // namespace scarp::pieces
