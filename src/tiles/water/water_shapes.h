// Lakes and rivers on the lattice: their nodes and surrounding boxes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/sample_runs.h"
#include "scarp/lines.h"
#include "tiles/water/tile_waters.h"

namespace scarp::tiles {

/// Nodes of a lattice. Columns may exceed a turn.
struct NodeBox {
  std::int64_t col = 0, row = 0;
  int cols = 0, rows = 0;
};

/// Largest number of nodes in a row that lines can count.
inline constexpr std::int64_t kMostNodes = (std::int64_t{1} << 22) - 1;

/// The box of nodes around points, with a margin of two nodes, clipped to the source's box; nothing if the boxes are
/// disjoint. `cols` and `rows` may exceed kMostNodes.
class NodesAround {
 public:
  void add(double col, double row);
  std::optional<NodeBox> box(const TileWaters& waters) const;

 private:
  double left_ = INFINITY, right_ = -INFINITY, top_ = INFINITY, bottom_ = -INFINITY;
};

/// Coordinates are columns and rows of the lattice.
std::vector<Line> lines_of(const TileLake& lake);
/// The box of a lake; nothing if the lake is outside the source or has more nodes in a row than lines can count.
std::optional<NodeBox> box_of(const TileLake& lake, const TileWaters& waters);

/// Maps nodes of a box, counted from its first, to columns and rows of the lattice.
inline std::array<double, 6> affine_of(const NodeBox& box) {
  return {static_cast<double>(box.col), 1, 0, static_cast<double>(box.row), 0, 1};
}

/// The nodes of a lake. Columns and rows are relative to its box.
std::vector<grid::SampleRun> nodes_of(const TileLake& lake, const NodeBox& box);

struct RiverNode {
  std::int64_t row = 0, col = 0;
  float height = 0;
};
/// The nodes of a river, sorted by rows, each once, with the lowest height of the river nearby.
std::vector<RiverNode> nodes_of(const TileRiver& river);

}  // namespace scarp::tiles
