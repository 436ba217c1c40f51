// A tile: a copy of a window of the raster, padded so that whole vectors can be read from it. Each point of a tile is
// one 32-bit number, with the row in the upper bits. The numerical order of points is raster order, and a triangle's
// three corners need 12 bytes. Such points work for rasters of any extent.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/point.h"

namespace scarp::geom {

/// column | row << 16, relative to the tile's first sample.
using TilePoint = std::uint32_t;

constexpr TilePoint tile_point(std::int32_t x, std::int32_t y) {
  return static_cast<TilePoint>(x) | static_cast<TilePoint>(y) << 16;
}
constexpr std::int32_t tile_x(TilePoint p) { return static_cast<std::int32_t>(p & 0xffff); }
constexpr std::int32_t tile_y(TilePoint p) { return static_cast<std::int32_t>(p >> 16); }
constexpr Point point_of(TilePoint p) { return {tile_x(p), tile_y(p)}; }

/// Longest side of a tile in samples. In-circle determinants stay below 2^53 (12 d⁴), and edge functions of slender
/// boxes below 2^24.
inline constexpr std::int32_t kMaxTileSide = 4097;

inline constexpr std::int32_t kBlock = 8;         ///< side of a block of the min/max pyramid, in samples
inline constexpr std::int32_t kTilePadding = 16;  ///< extra samples to the right of each row, and rows below the last

/// Borrowed samples of one tile, with the smallest and the largest height of each 8 × 8 block.
struct TileView {
  const float* samples = nullptr;  ///< row-major; NaN is nodata. `stride` floats per row, at least cols + kTilePadding,
                                   ///< and kTilePadding more rows than `rows`; the padding is readable, with any
                                   ///< contents
  std::ptrdiff_t stride = 0;
  std::int32_t cols = 0, rows = 0;  ///< 2 … kMaxTileSide
  /// Lowest and highest valid height of the block's samples; +infinity and −infinity if none. `block_stride` floats per
  /// row of blocks, at least the number of blocks + kTilePadding; padding has the values of blocks without heights.
  const float* block_low = nullptr;
  const float* block_high = nullptr;
  std::ptrdiff_t block_stride = 0;

  const float* row(std::int32_t y) const { return samples + y * stride; }
  float at(TilePoint p) const { return row(tile_y(p))[tile_x(p)]; }
};

}  // namespace scarp::geom
