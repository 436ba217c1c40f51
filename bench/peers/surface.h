// Meshes whose vertices lie anywhere, as files for the judge.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../speed/raw.h"

namespace bench {

/// Points (x = column, y = rows − 1 − row, z), triangles as triples of their ids, counter-clockwise from above.
struct Surface {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
};

/// Two counts (native uint32), then the two arrays.
inline void write_surface(const char* path, const Surface& surface) {
  const File file = open_file(path, "wb");
  const std::uint32_t counts[2] = {static_cast<std::uint32_t>(surface.points.size() / 3),
                                   static_cast<std::uint32_t>(surface.triangles.size() / 3)};
  const bool written =
      std::fwrite(counts, sizeof counts, 1, file.get()) == 1 &&
      std::fwrite(surface.points.data(), 8, surface.points.size(), file.get()) == surface.points.size() &&
      std::fwrite(surface.triangles.data(), 4, surface.triangles.size(), file.get()) == surface.triangles.size();
  if (!written) die(std::string("cannot write ") + path);
}

inline Surface read_surface(const char* path) {
  const File file = open_file(path, "rb");
  std::uint32_t counts[2] = {};
  Surface surface;
  bool read = std::fread(counts, sizeof counts, 1, file.get()) == 1;
  surface.points.resize(3 * std::size_t{counts[0]});
  surface.triangles.resize(3 * std::size_t{counts[1]});
  read = read && std::fread(surface.points.data(), 8, surface.points.size(), file.get()) == surface.points.size() &&
         std::fread(surface.triangles.data(), 4, surface.triangles.size(), file.get()) == surface.triangles.size();
  if (!read) die(std::string(path) + " is not a whole mesh");
  return surface;
}

/// Every sample a vertex, every cell two triangles cut along alternating diagonals.
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
