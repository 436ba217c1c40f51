// How far nodes are from the triangles of one tile.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "check/client_tile.h"

namespace scarp {

/// Heights of a rectangle of nodes, counted from the western and northern ends of the grid.
struct NodeBlock {
  NodeWindow window;
  World world;
  std::vector<float> heights;              ///< NaN: none
  std::vector<World::Meridian> meridians;  ///< meridians of the columns
  std::vector<World::Parallel> parallels;

  /// True if the four nodes around a cell, from its north-western corner, have heights.
  bool has_heights_around(std::int64_t col, std::int64_t row) const {
    const std::size_t side = static_cast<std::size_t>(window.cols),
                      first = static_cast<std::size_t>(row) * side + static_cast<std::size_t>(col);
    const float sum = heights[first] + heights[first + 1] + heights[first + side] + heights[first + side + 1];
    return sum == sum;
  }
  Place place(const World::Parallel& parallel, std::size_t col, double height) const {
    return world.place(parallel, meridians[col], height);
  }

  /// All of it but the heights.
  static NodeBlock begin(const NodeWindow& window, const World& world);
};

/// Nodes from the western and northern ends of the grid, the last ones included.
struct NodeRectangle {
  std::int64_t from_col = 0, to_col = -1, from_row = 0, to_row = -1;
};

/// The findings at nodes under a tile.
struct NodeVerdict {
  double node_error = 0;    ///< the largest |mesh − node|, where edges are straight on the map
  double distance = 0;      ///< the largest in space, from a node to the place of the flat triangle that stands for it
  double source_error = 0;  ///< the largest |mesh − sample|
  std::uint64_t nodes = 0;

  void add(const NodeVerdict& more);
};

class NodeJudge {
 public:
  /// `steps`: nodes' steps of a side of the tile, on the lattice of the block; `bound`: a distance above it is measured
  /// again, from the node to the nearest of all triangles.
  NodeJudge(const ClientTile& tile, std::int64_t steps, double background, double bound, const TileGrid& grid);

  /// The nodes of the block that lie under the tile. REQUIRES: columns of the block are those of the grid, not beyond.
  NodeVerdict judge(const NodeBlock& block) const;
  /// All nodes under the tile but those of the rectangle, or a turn from there: they have the background's height.
  /// Distances are upper bounds.
  NodeVerdict judge_outside(const NodeRectangle& inside, const World& world) const;

 private:
  /// A triangle on the lattice, columns and rows from the tile's north-western corner.
  struct OnLattice {
    std::array<double, 3> cols{}, rows{};
    std::array<std::uint32_t, 3> vertices{};
    double area = 0;  ///< twice, signed
  };
  OnLattice on_lattice(std::size_t k) const;
  /// Columns of a row in a triangle; from > to where there is none.
  static std::pair<double, double> columns_of(const OnLattice& triangle, double row);
  /// The distance of the first triangle that is within the bound; else infinity, or that of the nearest one around.
  double nearest(const Place& node) const;
  /// Position of a row of nodes, in steps from the tile's northern edge: rows need not be evenly apart.
  double line_of(std::int64_t row) const;

  const ClientTile& tile_;
  TileGrid grid_;
  DegreeBox box_;
  std::int64_t per_turn_;
  double steps_, background_, bound_;
  double first_col_ = 0, first_row_ = 0;
  std::vector<double> longest_;  ///< from each triangle's first corner
};

}  // namespace scarp
