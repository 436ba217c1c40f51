// Lines that the meshes of tiles have as edges.
//
// A level knows a line on its own lattice, `cells` steps a tile: the line is simplified to half a step, its vertices go
// to the nearest nodes of the lattice, and where it passes from a tile to the next there is one more, the nearest node
// on the edge. All this is a function of the line and the level, so that both tiles have the same vertex on their edge.
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
  /// A node of a tile: column, row, from its north-western corner.
  using Node = std::array<std::int32_t, 2>;
  /// The lines that pass a tile.
  struct Paths {
    std::vector<std::array<Node, 2>> steps;  ///< straight; none of them along an edge of the tile
    EdgeVertices edges;                      ///< nodes that must be vertices, ascending, each once
  };

  /// Builds the lines of levels 0 … max_zoom. `covered`: elsewhere nothing is known, but for tiles around it down to
  /// the block level.
  TileLines(std::vector<DegreeLine> lines, const TileGrid& grid, int cells, int max_zoom, int block_level,
            const DegreeBox& covered);

  const std::vector<DegreeLine>& lines() const { return lines_; }
  /// Null: nothing passes it.
  const Paths* find(TileId id) const;

 private:
  std::vector<DegreeLine> lines_;
  std::vector<std::map<std::pair<std::uint32_t, std::uint32_t>, Paths>> levels_;  ///< by row and column of tiles
};

}  // namespace scarp

#pragma GCC visibility pop
