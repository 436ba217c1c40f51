#include "tiles/mesh/tile_rows.h"

#include <algorithm>
#include <cmath>

#include "tiles/mesh/tile_edges.h"
#include "tiles/mesh/tile_mesh_parts.h"

namespace scarp::tiles {

TileRows::TileRows(const TileGrid& grid, TileId id, std::int32_t steps) : grid_(grid), steps_(steps) {
  const NodeWindow window = grid.window_of(id, steps);
  first_row_ = window.row;
  last_row_ = window.last_row();
  const DegreeBox box = grid.bounds_of(id);
  south_ = box.south;
  north_ = box.north;
  for (std::int32_t row = 0; !grid.has_even_rows() && row <= steps; ++row)
    lines_.push_back((north_ - window.latitude(first_row_ + row)) / (north_ - south_) * steps);
}

std::int32_t TileRows::above(double line) const {
  const std::int32_t last = steps_ - 1;
  if (are_even()) return std::clamp(static_cast<std::int32_t>(std::floor(line)), 0, last);
  const auto after = std::upper_bound(lines_.begin(), lines_.end(), line);
  return std::clamp(static_cast<std::int32_t>(after - lines_.begin()) - 1, 0, last);
}

std::int32_t TileRows::nearest(std::uint16_t v) const {
  if (are_even()) return steps_ - nearest_node(v, steps_, grid_.side_units());
  const double line = (32767 - v) * static_cast<double>(steps_) / 32767;
  const std::int32_t row = above(line);
  return row + (this->line(row + 1) - line < line - this->line(row) ? 1 : 0);
}

std::uint16_t TileRows::v_of(std::int64_t parts, std::int32_t per_step) const {
  if (are_even()) return quantized(parts, std::int64_t{per_step} * steps_, grid_.side_units());
  const double latitude = grid_.latitude((first_row_ + steps_) * per_step - parts, last_row_ * per_step);
  return static_cast<std::uint16_t>(std::floor(32767 * ((latitude - south_) / (north_ - south_)) + 0.5));
}

}  // namespace scarp::tiles
