// The bytes of quantized-mesh, a tile a file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/pyramid.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The bytes of a quantized-mesh 1.0 file, not compressed. With normals (extension 1), and with a water mask (extension
/// 2) that is not empty. Deterministic: no function of the machine's mathematics library is called.
std::vector<std::uint8_t> encode_quantized_mesh(const TerrainTile& tile, const Geodetic& ellipsoid = {},
                                                const TileGrid& grid = {},
                                                std::span<const std::uint8_t> water_mask = {});

/// A quantized-mesh file, as clients read it.
struct QuantizedMesh {
  std::array<double, 3> center{};
  float min_height = 0, max_height = 0;
  std::array<double, 4> sphere{};  ///< centre, radius
  std::array<double, 3> horizon_point{};
  std::vector<std::uint16_t> u, v, h;  ///< 0 … 32767
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> west, south, east, north;  ///< vertices on the edges
  std::vector<std::array<std::uint8_t, 2>> normals;     ///< empty, or one a vertex
  /// 0 land, 255 water; of all the tile, or 256 rows of 256 texels from the north. Empty without one; any other size is
  /// a fault of the file's.
  std::vector<std::uint8_t> water_mask;

  /// The height that clients decode: min + (max − min) · h / 32767.
  double height(std::size_t vertex) const {
    const double low = double{min_height}, high = double{max_height};
    return low + (high - low) * (static_cast<double>(h[vertex]) / 32767);
  }
};

/// Fails with kInput for what is no such file; never trusts a length or an index in it.
Result<QuantizedMesh> decode_quantized_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

}  // namespace scarp

#pragma GCC visibility pop
