// The full grid of a raster, the start of edge collapse.
#pragma once

#include "../speed/raw.h"

namespace bench {

/// A vertex for each sample, and two triangles for each cell, split along alternating diagonals.
inline Surface full_grid(const RawRaster& raster) {
  Surface surface;
  for (int row = 0; row < raster.rows; ++row) {
    for (int col = 0; col < raster.cols; ++col) {
      const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.cols) + std::size_t(col);
      surface.points.insert(surface.points.end(), {double(col), double(raster.rows - 1 - row), raster.samples[at]});
    }
  }
  const auto cols = static_cast<std::uint32_t>(raster.cols), rows = static_cast<std::uint32_t>(raster.rows);
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t col = 0; col + 1 < cols; ++col) {
      const std::uint32_t nw = row * cols + col, ne = nw + 1, sw = nw + cols, se = sw + 1;
      if ((row + col) % 2 == 0)
        surface.triangles.insert(surface.triangles.end(), {nw, sw, se, nw, se, ne});
      else
        surface.triangles.insert(surface.triangles.end(), {nw, sw, ne, ne, sw, se});
    }
  }
  return surface;
}

}  // namespace bench
