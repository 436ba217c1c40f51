// A tile as clients decode it, in any format.
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

namespace scarp::check {

/// The length of a tile's side: positions are 0 … 32767.
inline constexpr double kWholeTile = 32767;

enum TileSide : std::size_t { kWest, kSouth, kEast, kNorth };

struct ClientTile {
  TileId id;
  TileFormat format = TileFormat::kQuantizedMesh;
  DegreeBox box;
  bool is_flat = false;  ///< on the plane of a local grid
  /// Positions from the west and from the south, 0 … 32767; integers except in GLB files, which store positions in
  /// space.
  std::vector<double> u, v;
  std::vector<double> heights;  ///< metres above the ellipsoid or the plane
  std::vector<Place> places;
  std::vector<std::array<float, 3>> normals;  ///< normals of the vertices as stored, not decoded; empty if absent
  std::vector<float> uvs;                     ///< by vertex, its position in `image`; empty if absent
  GlbImage image;                             ///< empty if absent
  std::vector<std::uint32_t> triangles;
  std::vector<Place> skirt;  ///< pairs: a point on an edge, and one below it; empty if absent
  std::vector<std::uint32_t> skirt_triangles;
  std::vector<std::uint8_t> water_mask;             ///< empty if absent
  std::array<std::vector<std::uint32_t>, 4> edges;  ///< by TileSide, vertices in the order of the file

  std::optional<Place> centre;
  double low = 0, high = 0;  ///< heights in the tile's header
  Place sphere_centre{};
  double radius = 0;
  Place horizon{};        ///< horizon point in units of the axes; NaN if none
  double resolution = 0;  ///< smallest distance that the GLB file resolves, metres
};

/// `facts`: the subtree's data about the tile; null: use the file's data. Fails with kInput.
Result<ClientTile> decode_client_tile(TileFormat format, std::span<const std::uint8_t> bytes, TileId id,
                                      const TileGrid& grid, const World& world, const io::TileFacts* facts);

/// Geographic coordinates of a position in a tile.
Geographic geographic_at(const DegreeBox& box, double u, double v, double height);

}  // namespace scarp::check
