// Lines that become edges of tile meshes.
//
// A level has its own lattice for lines, with `cells` steps per tile. A line is simplified with a tolerance of half a
// step, and its vertices are moved to the nearest lattice nodes. Where it crosses an edge between tiles, the nearest
// node on the edge becomes a vertex. All this depends only on the line and the level, so both tiles have the same
// vertex on their edge.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/options.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

class TileLines {
 public:
  /// A node of a tile: column and row from its north-western corner.
  using Node = std::array<std::int32_t, 2>;
  struct Paths {
    std::vector<std::array<Node, 2>> steps;  ///< segments; none of them along an edge of the tile
    EdgeVertices edges;                      ///< nodes that must be vertices: ascending, each once
  };

  /// Builds the lines of levels 0 … max_zoom. `covered`: the area of lines, with neighbouring tiles down to the block
  /// level.
  TileLines(std::vector<DegreeLine> lines, const TileGrid& grid, int cells, int max_zoom, int block_level,
            const DegreeBox& covered);

  const std::vector<DegreeLine>& lines() const { return lines_; }
  /// Null if no line passes through the tile.
  const Paths* find(TileId id) const;

 private:
  std::vector<DegreeLine> lines_;
  std::vector<std::map<std::pair<std::uint32_t, std::uint32_t>, Paths>> levels_;  ///< by row and column of tiles
};

}  // namespace scarp

#pragma GCC visibility pop
