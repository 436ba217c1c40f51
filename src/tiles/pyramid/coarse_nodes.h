// Nodes above the blocks: decimated, with error bounds for each cell.
//
// A coarse tile holds 128 × 128 cells. Each cell stores bounds on how far the source's nodes in it lie below and above
// the bilinear surface between its corners. Bilinear means bilinear in degrees, because triangles are planes in degrees
// for any spacing of rows. Four coarse tiles become one tile of the level above, which omits every second node. The
// difference of the bilinear surfaces of both levels is also bilinear, so its extremes are at corners, and the bounds
// can be added. If the sum exceeds the range of heights in the cell, the range is used.
//
// The source's samples lie between the nodes and may exceed the bounds of a cell's nodes. One number per cell bounds
// the excess over both bounds; a joined cell has the largest number of its parts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp::tiles {

/// Bounds over the nodes in a cell: of node − bilinear surface, and of heights.
struct CoarseCell {
  float low = 0, high = 0;
  float min = 0, max = 0;
  float apart = 0;  ///< largest excess of samples over both bounds; NaN if unknown
};

/// Heights at the corners of a cell; x and y are 0 … 1 from its north-western corner.
struct Corners {
  double nw = 0, ne = 0, sw = 0, se = 0;

  double at(double x, double y) const {
    const double north = nw + (ne - nw) * x, south = sw + (se - sw) * x;
    return north + (south - north) * y;
  }
};

class CoarseTile {
 public:
  /// Reduces the nodes of a tile, a multiple of kCoarseCells a side, and the samples of `source` in it. Fails like the
  /// source.
  static Result<CoarseTile> reduce(const PyramidPlan& plan, TileId id, const TileNodes& nodes,
                                   const NodeSource& source);
  /// A tile without heights.
  static CoarseTile flat(float height);
  /// Makes a tile of the level above. `children`: north-west, north-east, south-west, south-east.
  static CoarseTile join(const TileGrid& grid, TileId id, const std::array<const CoarseTile*, 4>& children);

  /// Little-endian floats: nodes, then cells.
  std::vector<std::uint8_t> to_bytes() const;
  /// The inverse of to_bytes() for a tile with heights. Fails with kInput for another number of bytes.
  static Result<CoarseTile> from_bytes(std::span<const std::uint8_t> bytes);

  float node(std::int32_t col, std::int32_t row) const {
    return nodes_[static_cast<std::size_t>(row * (kCoarseCells + 1) + col)];
  }
  CoarseCell cell(std::int32_t col, std::int32_t row) const {
    return cells_[static_cast<std::size_t>(row * kCoarseCells + col)];
  }
  Corners corners(std::int32_t col, std::int32_t row) const {
    return {node(col, row), node(col + 1, row), node(col, row + 1), node(col + 1, row + 1)};
  }
  bool has_heights = true;

 private:
  Result<void> look_at_samples(const PyramidPlan& plan, TileId id, const TileNodes& nodes, const NodeSource& source);

  std::vector<float> nodes_;
  std::vector<CoarseCell> cells_;
};

/// The coarse tiles of a level, as a source for tiles of the level above it.
class CoarseLevel final : public NodeSource {
 public:
  CoarseLevel(int z, float background) : z_(z), flat_(CoarseTile::flat(background)) {}

  void add(std::uint32_t x, std::uint32_t y, CoarseTile tile) { tiles_.insert_or_assign(key(x, y), std::move(tile)); }
  const CoarseTile& at(std::uint32_t x, std::uint32_t y) const;
  Result<void> read(const NodeWindow& window, std::span<float> out) const override;

 private:
  static std::uint64_t key(std::uint32_t x, std::uint32_t y) { return std::uint64_t{y} << 32 | x; }

  int z_;
  CoarseTile flat_;
  std::map<std::uint64_t, CoarseTile> tiles_;
};

struct CoarseVerdict {
  double node_error = 0;
  double source_error = 0;  ///< NaN if unknown
};

/// Bounds |mesh − node| over all nodes of the source under a tile of the level above `level`, and |mesh − sample|.
CoarseVerdict bound_errors(const TerrainTile& tile, const TileGrid& grid, const CoarseLevel& level);

}  // namespace scarp::tiles
