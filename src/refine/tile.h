// A copy of the samples of one tile.
#pragma once

#include <cstdint>

#include "base/array.h"
#include "geom/tile_view.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::refine {

/// A window of the raster, corners included. Windows of neighbours share a row or a column of samples.
struct TileWindow {
  std::int32_t col = 0, row = 0, cols = 0, rows = 0;
};

/// Padded samples and blocks, refilled for each tile: memory is reused.
class Tile {
 public:
  /// Fails if the field's source fails. REQUIRES: a window in the raster, sides 2 … kMaxTileSide.
  Result<void> load(const HeightField& field, const TileWindow& window);
  /// Loads every `step`-th sample of a tile, from the first on. REQUIRES: at least two such samples each way.
  void load_coarse(const Tile& fine, std::int32_t step);

  const geom::TileView& view() const { return view_; }
  bool is_whole() const { return nodata_ == 0; }
  float largest_height() const { return largest_height_; }  ///< largest magnitude of valid samples

 private:
  float* resize(std::int32_t cols, std::int32_t rows);
  void fill_padding();
  void fill_blocks();

  Array<float> samples_, low_, high_;
  geom::TileView view_;
  std::uint64_t nodata_ = 0;
  float largest_height_ = 0;
};

}  // namespace scarp::refine
