// The division of a raster into tiles.
#pragma once

#include <cstdint>
#include <vector>

#include "pieces/border_chain.h"
#include "refine/tile.h"
#include "refine/tile_scanner.h"

namespace scarp::pieces {

/// Tiles of nearly equal sides.
class Tiling {
 public:
  /// Sides are 0.5 to 1.5 times `side` if the raster is that large.
  Tiling(std::int32_t cols, std::int32_t rows, std::int32_t side);

  std::size_t per_row() const { return x_.size() - 1; }
  std::size_t per_column() const { return y_.size() - 1; }
  std::size_t count() const { return per_row() * per_column(); }
  /// Tiles are numbered row by row.
  refine::TileWindow window(std::size_t tile) const;
  refine::SharedSides shared(std::size_t tile) const;

 private:
  std::vector<std::int32_t> x_, y_;
};

/// The sides of a window that are shared, as lines of the raster.
std::vector<BorderLine> shared_lines(const refine::TileWindow& window, const refine::SharedSides& shared);

}  // namespace scarp::pieces
