#include "refine/tile.h"

#include <algorithm>
#include <limits>

#include "geom/scan_kernels.h"
#include "grid/window.h"

namespace scarp::refine {

namespace {

void grow(Array<float>& values, std::ptrdiff_t least) {
  if (values.size() < static_cast<std::size_t>(least)) values.resize(static_cast<std::size_t>(least));
}

}  // namespace

float* Tile::resize(std::int32_t cols, std::int32_t rows) {
  std::ptrdiff_t stride =
      (cols + geom::kTilePadding - 1) / geom::kTilePadding * geom::kTilePadding + geom::kTilePadding;
  // Rows at multiples of 4 KiB would share a few cache lines.
  if (stride % 1024 == 0) stride += geom::kTilePadding;
  const std::ptrdiff_t block_rows = (rows + geom::kBlock - 1) / geom::kBlock;
  const std::ptrdiff_t block_stride = (cols + geom::kBlock - 1) / geom::kBlock + geom::kTilePadding;
  grow(samples_, stride * (rows + geom::kTilePadding));
  grow(low_, block_stride * block_rows);
  grow(high_, block_stride * block_rows);
  view_ = {samples_.data(), stride, cols, rows, low_.data(), high_.data(), block_stride};
  return samples_.data();
}

void Tile::fill_padding() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  float* const samples = samples_.data();
  for (std::ptrdiff_t y = 0; y < view_.rows; ++y)
    std::fill(samples + y * view_.stride + view_.cols, samples + (y + 1) * view_.stride, kNan);
  std::fill_n(samples + view_.rows * view_.stride, geom::kTilePadding * view_.stride, kNan);
}

void Tile::fill_blocks() {
  fill_padding();
  nodata_ = 0;
  largest_height_ = geom::scan_kernels().fill_blocks(view_, low_.data(), high_.data(), nodata_);
}

Result<void> Tile::load(const HeightField& field, const TileWindow& window) {
  float* samples = resize(window.cols, window.rows);
  if (auto read = grid::read_window(field, window.col, window.row, window.cols, window.rows, samples, view_.stride);
      !read)
    return read;
  fill_blocks();
  return {};
}

void Tile::load_coarse(const Tile& fine, std::int32_t step) {
  const geom::TileView& from = fine.view();
  float* samples = resize((from.cols - 1) / step + 1, (from.rows - 1) / step + 1);
  for (std::int32_t y = 0; y < view_.rows; ++y) {
    const float* row = from.row(y * step);
    for (std::int32_t x = 0; x < view_.cols; ++x) samples[y * view_.stride + x] = row[x * step];
  }
  fill_blocks();
}

}  // namespace scarp::refine
