// Conversion of degrees to columns and rows of nodes.
#pragma once

#include <cmath>
#include <cstdint>

#include "scarp/tile.h"

namespace scarp::globe {

/// Division, rounded down. REQUIRES: by > 0.
inline std::int64_t floor_of(std::int64_t value, std::int64_t by) {
  return value / by - (value % by != 0 && value < 0 ? 1 : 0);
}

class NodePlaces {
 public:
  NodePlaces(const TileGrid& grid, std::int64_t per_turn) { lattice_ = {per_turn, 0, 0, 0, 0, grid}; }

  /// Column of a longitude, which may exceed a turn.
  double col(double longitude) const { return (longitude + 180) / 360 * static_cast<double>(lattice_.per_turn); }

  /// Fractional row of a latitude; clamped to row 0 in the north and the last row in the south.
  double row(double latitude) const {
    std::int64_t above = 0, below = lattice_.last_row();
    if (latitude >= lattice_.latitude(above)) return static_cast<double>(above);
    if (latitude <= lattice_.latitude(below)) return static_cast<double>(below);
    while (below - above > 1) {
      const std::int64_t middle = above + (below - above) / 2;
      (lattice_.latitude(middle) >= latitude ? above : below) = middle;
    }
    const double from = lattice_.latitude(above);
    return static_cast<double>(above) + (from - latitude) / (from - lattice_.latitude(below));
  }

 private:
  NodeWindow lattice_;
};

}  // namespace scarp::globe
