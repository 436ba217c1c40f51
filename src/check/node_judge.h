// Distances between nodes and the triangles of one tile.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "check/client_tile.h"

namespace scarp::check {

/// Heights of a rectangle of nodes. Columns count from the western end of the grid, rows from the northern.
struct NodeBlock {
  NodeWindow window;
  World world;
  std::vector<float> heights;              ///< NaN: nodata
  std::vector<World::Meridian> meridians;  ///< meridians of the columns
  std::vector<World::Parallel> parallels;

  /// True if the four nodes of a cell, given by its north-western corner, have heights.
  bool has_heights_around(std::int64_t col, std::int64_t row) const {
    const std::size_t side = static_cast<std::size_t>(window.cols),
                      first = static_cast<std::size_t>(row) * side + static_cast<std::size_t>(col);
    const float sum = heights[first] + heights[first + 1] + heights[first + side] + heights[first + side + 1];
    return sum == sum;
  }
  Place place(const World::Parallel& parallel, std::size_t col, double height) const {
    return world.place(parallel, meridians[col], height);
  }

  /// A block without its heights.
  static NodeBlock begin(const NodeWindow& window, const World& world);
};

/// Columns and rows of nodes, counted from the western and northern ends of the grid, inclusive.
struct NodeRectangle {
  std::int64_t from_col = 0, to_col = -1, from_row = 0, to_row = -1;
};

/// The findings at nodes under a tile.
struct NodeVerdict {
  double node_error = 0;    ///< the largest |mesh − node|, with edges straight on the map
  double distance = 0;      ///< the largest distance in space from a node to its corresponding point on the flat
                            ///< triangle
  double source_error = 0;  ///< the largest |mesh − sample|
  std::uint64_t nodes = 0;

  void add(const NodeVerdict& more);
};

class NodeJudge {
 public:
  /// `steps`: node intervals along a side of the tile, on the lattice of the block. `bound`: larger distances are
  /// measured again, to the nearest of all triangles.
  NodeJudge(const ClientTile& tile, std::int64_t steps, double background, double bound, const TileGrid& grid);

  /// Judges the nodes of the block that lie under the tile. REQUIRES: columns of the block lie within the grid.
  NodeVerdict judge(const NodeBlock& block) const;
  /// Judges all nodes under the tile that are outside the rectangle and outside its copy one turn away. These nodes
  /// have the background's height. Distances are upper bounds.
  NodeVerdict judge_outside(const NodeRectangle& inside, const World& world) const;

 private:
  /// A triangle on the lattice; columns and rows count from the tile's north-western corner.
  struct OnLattice {
    std::array<double, 3> cols{}, rows{};
    std::array<std::uint32_t, 3> vertices{};
    double area = 0;  ///< twice, signed
  };
  OnLattice on_lattice(std::size_t k) const;
  /// Range of columns of a row in a triangle; first > second if none.
  static std::pair<double, double> columns_of(const OnLattice& triangle, double row);
  /// The distance to the first triangle that is found within the bound. If there is none: the least distance to the
  /// triangles nearby, or infinity.
  double nearest(const Place& node) const;
  /// Position of a row of nodes in steps from the tile's northern edge; rows may be unevenly spaced.
  double line_of(std::int64_t row) const;

  const ClientTile& tile_;
  TileGrid grid_;
  DegreeBox box_;
  std::int64_t per_turn_;
  double steps_, background_, bound_;
  double first_col_ = 0, first_row_ = 0;
  std::vector<double> longest_;  ///< longest distance from each triangle's first corner
};

}  // namespace scarp::check
