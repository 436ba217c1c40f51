// The latitudes of a tile's rows of nodes for clients, who divide the degrees between its southern and its northern end
// into 32767 equal steps, or into those of a local grid.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tile.h"

namespace scarp {

class TileRows {
 public:
  /// `steps`: of nodes on the tile's sides. Rows go south.
  TileRows(const TileGrid& grid, TileId id, std::int32_t steps);

  std::int32_t steps() const { return steps_; }
  bool are_even() const { return lines_.empty(); }
  /// In steps below the northern end: the row's number where rows are evenly apart.
  double line(std::int32_t row) const { return are_even() ? row : lines_[static_cast<std::size_t>(row)]; }
  /// The row at or above a line, of those that have one below.
  std::int32_t above(double line) const;
  /// The row next to a vertex's v.
  std::int32_t nearest(std::uint16_t v) const;
  /// v, 0 … grid.side_units() from the southern end, of a place `parts` of `per_step` steps north of it.
  std::uint16_t v_of(std::int64_t parts, std::int32_t per_step = 1) const;

 private:
  TileGrid grid_;
  std::int32_t steps_;
  std::int64_t first_row_, last_row_;  ///< the tile's northern row and the last of all, from the grid's northern end
  double south_, north_;               ///< degrees
  std::vector<double> lines_;          ///< empty where rows are evenly apart
};

}  // namespace scarp
