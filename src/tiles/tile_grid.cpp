#include "scarp/tile_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp {
namespace {

constexpr double kPi = 3.141592653589793;

}  // namespace

std::span<const double> TileGrid::turns() const {
  static constexpr std::array<double, 5> kTurns{-720, -360, 0, 360, 720};
  return kTurns;
}

DegreeBox TileGrid::bounds_of(TileId id) const {
  const double side = std::ldexp(180.0, -id.z);
  return {-180 + id.x * side, -90 + id.y * side, -180 + (id.x + 1.0) * side, -90 + (id.y + 1.0) * side};
}

NodeWindow TileGrid::window_of(TileId id, std::int32_t steps, std::int32_t halo) const {
  NodeWindow window{per_turn(id.z, steps), std::int64_t{id.x} * steps - halo, 0, steps + 1 + 2 * halo, 0, *this};
  const std::int64_t row = (std::int64_t{rows(id.z)} - 1 - id.y) * steps;
  window.row = std::max<std::int64_t>(row - halo, 0);
  window.rows = static_cast<int>(std::min(row + steps + halo, window.last_row()) - window.row + 1);
  return window;
}

double TileGrid::geometric_error(int z, double semi_major) const {
  return std::ldexp(semi_major * 2 * kPi * 0.25 / (65 * roots()), -z);
}

double TileGrid::tile_width(int z, double semi_major) const {
  return std::ldexp(kPi * semi_major * (2.0 / roots()), -z);
}

}  // namespace scarp
