// A tile as clients decode it, whatever its format.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/space.h"
#include "io/tiles3d.h"
#include "scarp/tile.h"
#include "scarp/tile_set.h"

namespace scarp {

/// 0 … 32767 of a tile's side.
inline constexpr double kWholeTile = 32767;

enum TileSide : std::size_t { kWest, kSouth, kEast, kNorth };

struct ClientTile {
  TileId id;
  TileFormat format = TileFormat::kQuantizedMesh;
  DegreeBox box;
  bool is_flat = false;  ///< on the plane of a local grid
  /// Positions 0 … 32767 from west, from south; whole numbers but in GLB files, which hold places in space.
  std::vector<double> u, v;
  std::vector<double> heights;  ///< metres above the world
  std::vector<Place> places;
  std::vector<std::array<float, 3>> normals;  ///< empty, or of each vertex what the file holds, as numbers
  std::vector<float> uvs;                     ///< empty, or two of each vertex: its place in `image`
  GlbImage image;                             ///< empty without one
  std::vector<std::uint32_t> triangles;
  std::vector<Place> skirt;  ///< pairs: on an edge, and below; empty without one in the file
  std::vector<std::uint32_t> skirt_triangles;
  std::vector<std::uint8_t> water_mask;             ///< empty without one
  std::array<std::vector<std::uint32_t>, 4> edges;  ///< by TileSide: vertices as the file lists them

  std::optional<Place> centre;
  double low = 0, high = 0;  ///< heights in its header
  Place sphere_centre{};
  double radius = 0;
  Place horizon{};        ///< in units of the axes; NaN where there is none
  double resolution = 0;  ///< metres between the positions that a GLB file can distinguish
};

/// `facts`: the subtree's data about it; without them the file's own count. Fails with kInput.
Result<ClientTile> decode_client_tile(TileFormat format, std::span<const std::uint8_t> bytes, TileId id,
                                      const TileGrid& grid, const World& world, const TileFacts* facts);

/// Degrees of a place in a tile.
Geographic geographic_at(const DegreeBox& box, double u, double v, double height);

}  // namespace scarp
