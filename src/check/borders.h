// Comparison of neighbouring tiles' edges.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "check/client_tile.h"
#include "scarp/tile_set.h"

namespace scarp::check {

/// A vertex on an edge. Two vertices are the same if their `key` and `normal` are equal.
struct EdgeVertex {
  double along = 0, height = 0;  ///< along: 0 … 32767; height: metres
  Place key{};                   ///< position that neighbours must decode identically
  std::array<float, 3> normal{};
};
using TileEdge = std::vector<EdgeVertex>;

/// The four edges, by TileSide, each ordered from south or west.
struct TileEdges {
  TileId id;
  std::array<TileEdge, 4> sides;
};
TileEdges take_edges(const ClientTile& tile);

/// The largest height difference between two edges, metres.
double largest_gap(const TileEdge& one, const TileEdge& other);

/// Compares the tiles of one level. Add the tiles row by row from the south, and from the west in each row. Stores the
/// edges of one row.
class BorderWatch {
 public:
  /// Borrows `level` and `faults`; adds counts and faults to them.
  BorderWatch(TileFormat format, const TileGrid& grid, int z, CheckedLevel& level, std::vector<TileFault>& faults)
      : format_(format), grid_(grid), z_(z), level_(level), faults_(faults) {}

  void add(TileEdges tile);
  /// Call it after the last tile.
  void finish() { end_row(); }

 private:
  struct Row {
    std::int64_t y = -2;
    std::map<std::uint32_t, TileEdges> tiles;
  };
  void end_row();
  void compare(const TileEdges& here, TileSide side, const TileEdges& there, TileSide other);
  void compare_corner(const TileEdges& here, const EdgeVertex& mine, const TileEdges& there, const EdgeVertex& theirs);
  void check_pole(const TileEdges& tile, TileSide side);
  bool wraps() const { return grid_.turns().size() > 1; }

  TileFormat format_;
  TileGrid grid_;
  int z_;
  CheckedLevel& level_;
  std::vector<TileFault>& faults_;
  Row row_, below_;
  std::map<TileSide, EdgeVertex> poles_;  ///< first vertex at each pole
};

}  // namespace scarp::check
