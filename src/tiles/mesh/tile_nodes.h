// The nodes of a tile, and a few around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Cells on a side of the coarse tiles that form the levels above the blocks (coarse_nodes.h).
inline constexpr std::int32_t kCoarseCells = 128;
/// Steps on a side of a tile at or below the plan's block level.
inline std::int32_t steps_of(const PyramidPlan& plan, int z) { return plan.cells << (plan.max_zoom() - z); }

/// Nodes of a tile: columns from its western side to `right`, rows from `top` to `bottom`.
struct NodeArea {
  std::int32_t top = 0, right = 0, bottom = 0;

  friend bool operator==(const NodeArea&, const NodeArea&) = default;
};
/// The part with land of a tile with `steps` steps: the whole tile, unless a local grid's raster covers only a part.
NodeArea land_of(const TileGrid& grid, TileId id, std::int32_t steps);

/// The nodes of a tile: steps + 1 per side, and `halo` more on each side. The last row repeats beyond the grid's ends.
class TileNodes {
 public:
  /// `steps`: those of the tile's sides. Nodes without a height have the background's height.
  static Result<TileNodes> read(const PyramidPlan& plan, TileId id, std::int32_t steps, std::int32_t halo,
                                const NodeSource& source);

  /// Nodes of the same height, with a halo of one node. At least `least_steps` steps; more if necessary to end at the
  /// end of the land.
  static TileNodes flat(const PyramidPlan& plan, TileId id, std::int32_t least_steps);

  std::int32_t steps() const { return steps_; }
  const NodeArea& land() const { return land_; }
  bool has_heights() const { return has_heights_; }  ///< true if at least one of its own nodes has a height
  /// True if some of its own nodes have the background's height.
  bool has_voids() const { return !voids_.empty(); }
  /// True if the tile's own four nodes around a place had heights. REQUIRES: 0 <= col, row <= steps.
  bool has_heights_around(double col, double row) const;
  /// True if all nodes, including the halo, have the background's height.
  bool is_flat() const { return is_flat_; }
  /// REQUIRES: −halo <= col, row <= steps + halo. Rows go south.
  float at(std::int32_t col, std::int32_t row) const { return heights_[index(col, row)]; }
  /// The heights of a row from a column on, contiguous.
  const float* from(std::int32_t col, std::int32_t row) const { return &heights_[index(col, row)]; }

 private:
  std::size_t index(std::int32_t col, std::int32_t row) const {
    return static_cast<std::size_t>(row + halo_) * static_cast<std::size_t>(side()) +
           static_cast<std::size_t>(col + halo_);
  }
  /// Nodes from a first column and row on, which are negative in the halo.
  struct Part {
    std::int32_t left = 0, top = 0, cols = 0, rows = 0;
  };
  /// Sets the background's height at nodes of the part without a height; nodes outside have none.
  void fill_voids(std::span<float> heights, const Part& part, float background);
  std::int32_t side() const { return steps_ + 1 + 2 * halo_; }

  std::int32_t steps_ = 0, halo_ = 0;
  NodeArea land_;
  std::vector<float> heights_;
  std::vector<bool> voids_;  ///< voids of its own nodes; empty without any
  bool has_heights_ = false, is_flat_ = true;
};

}  // namespace scarp::tiles
