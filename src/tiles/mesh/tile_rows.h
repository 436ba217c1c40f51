// Latitudes of a tile's rows of nodes as clients place them. Clients divide the degrees between its southern and
// northern end into 32767 equal steps, or into the steps of a local grid.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

class TileRows {
 public:
  /// `steps`: steps of nodes on the tile's sides. Rows go south.
  TileRows(const TileGrid& grid, TileId id, std::int32_t steps);

  std::int32_t steps() const { return steps_; }
  bool are_even() const { return lines_.empty(); }
  /// Steps below the northern end: the row's number if rows are evenly spaced.
  double line(std::int32_t row) const { return are_even() ? row : lines_[static_cast<std::size_t>(row)]; }
  /// The row at or above a line, but never the last row.
  std::int32_t above(double line) const;
  /// The row nearest to a vertex's v.
  std::int32_t nearest(std::uint16_t v) const;
  /// v, 0 … grid.side_units() from the southern end, of a place that is parts / per_step steps north of this end.
  std::uint16_t v_of(std::int64_t parts, std::int32_t per_step = 1) const;

 private:
  TileGrid grid_;
  std::int32_t steps_;
  std::int64_t first_row_, last_row_;  ///< the tile's northern row and the grid's last, from the grid's northern end
  double south_, north_;               ///< degrees
  std::vector<double> lines_;          ///< empty if rows are evenly spaced
};

}  // namespace scarp::tiles
