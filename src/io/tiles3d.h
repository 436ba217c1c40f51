// 3D Tiles 1.1 of terrain: the tiles of a pyramid as GLB files, and the metadata files that list them. CesiumJS uses a
// set both as terrain (Cesium3DTilesTerrainProvider) and as an ordinary tileset; so do other clients of 3D Tiles.
//
// POSITIONS are earth-centred and lie on one lattice a level: whole multiples of a power of two, at most 1/32 of the
// level's max error. Vertices that neighbours share are the same doubles in both. On the plane of a local grid they are
// metres from the raster's centre, and on its samples.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "io/globe_image.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Metres between the points of a level's lattice, each way: where 16 bits hold a tile of the level, as fine as they
/// do, but no finer than 1/256 of its max error. On a local grid's plane vertices lie on it, east, north and up.
std::array<double, 3> lattice_steps(const PyramidPlan& plan, int z);

/// The most that the lattice moves a vertex, in metres: √3/2 of the step, 0 on a plane. Adds to TerrainTile::bound().
/// The sum bounds the distance in space between a node and the triangles.
double lattice_error(const PyramidPlan& plan, int z);

/// The facts about a tile that clients need in addition to its mesh.
struct TileFacts {
  /// Bounds of the triangles, metres above the ellipsoid or the plane; what flat ones lie below its curve is included.
  double min_height = 0, max_height = 0;
  std::array<double, 4> sphere{};  ///< holds the triangles: centre, radius
  /// In units of the ellipsoid's axes: who does not see it sees none of the tile. Always finite; far out for tiles that
  /// cannot be hidden so. 0, 0, 0 where there is no horizon: on the plane of a local grid.
  std::array<double, 3> horizon_point{};

  bool has_horizon() const { return horizon_point != std::array<double, 3>{}; }

  friend bool operator==(const TileFacts&, const TileFacts&) = default;
};

/// A tile in space.
struct EarthTile {
  std::array<double, 3> steps{1, 1, 1};               ///< metres, each way; all the same on a globe
  std::array<std::int64_t, 3> origin{};               ///< in steps: x towards 0° E, z towards the north pole
  std::vector<std::array<std::uint32_t, 3>> offsets;  ///< from there, in steps, below 2^24
  std::vector<std::array<double, 3>> normals;         ///< normals of unit length
  std::vector<std::array<double, 2>> places;          ///< 0 … 1 of the tile from west, from north
  std::vector<std::uint32_t> triangles;               ///< counter-clockwise seen from outside
  /// Vertices on the edges, clockwise around the tile seen from outside, as CesiumJS expects them.
  std::vector<std::uint32_t> west, north, east, south;
  /// The skirt's lower ends, in steps from the origin: one below each vertex of west, north, east and south. None where
  /// there is no neighbour: at a pole, and where the raster of a local grid ends.
  std::array<std::vector<std::array<std::uint32_t, 3>>, 4> feet;
  TileFacts facts;  ///< without the skirt
};

/// Metres that skirts hang down: 5 times the level's geometric error, as in CesiumJS and cesium-native for terrain, or
/// of its max error where that is larger. This is enough next to tiles two levels coarser.
double skirt_depth(const PyramidPlan& plan, int z);

/// A function of the tile and the plan. No function of the machine's mathematics library enters it.
EarthTile place_on_earth(const TerrainTile& tile, const PyramidPlan& plan);

struct TileGlbOptions {
  /// EXT_meshopt_compression (version 0 of the codec) and KHR_mesh_quantization. Positions then have 16 bits where the
  /// lattice's offsets do, normals 8. Ignored in builds without libmeshoptimizer. DEFAULT: true.
  bool compress = true;
  std::optional<TileTexture> texture = std::nullopt;  ///< DEFAULT: none, the ground has one colour.
};

/// The bytes of a GLB file: one node with a matrix, and one mesh. Its first primitive is the surface, with
/// CESIUM_tile_edges, clockwise: CesiumJS uses it alone for terrain. The second one is the skirt, as its extras
/// declare; its vertices are pairs, one on an edge and one below. Its y is up, as glTF demands: clients of 3D Tiles
/// turn it back. A texture's coordinates are whole 65535ths. asset.extras hold the facts. Fails as encode_glb().
Result<std::vector<std::uint8_t>> encode_tile_glb(const EarthTile& tile, const TileGlbOptions& options = {});

/// The facts of a tile that encode_tile_glb() wrote. Fails with kInput for other files.
Result<TileFacts> read_tile_facts(std::span<const std::uint8_t> glb);

/// A tile of terrain in a GLB file, as clients of 3D Tiles decode it: turned back to the earth's axes.
struct TileGlb {
  std::vector<std::array<double, 3>> positions;  ///< metres; shared vertices are the same doubles in Scarp's tiles
  std::vector<std::array<double, 3>> normals;    ///< empty, or one a vertex
  std::vector<float> uvs;                        ///< empty, or two a vertex: its place in `image`, from the top left
  GlbImage image;                                ///< empty without one in the file
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> west, south, east, north;  ///< edges of CESIUM_tile_edges, in its order
  std::vector<std::array<double, 3>> skirt;             ///< pairs: on an edge, and below; no part of the surface
  std::vector<std::uint32_t> skirt_triangles;
  double step = 0;  ///< metres between the positions that the file can distinguish, the largest; 0 for single precision
  TileFacts facts;
};

/// Fails with kInput for what is no such file of Scarp's; believes nothing in it.
Result<TileGlb> decode_tile_glb(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

/// A set's tiles, by level, row and column.
using FactsByTile = std::map<std::tuple<int, std::uint32_t, std::uint32_t>, TileFacts>;

struct NamedFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// tileset.json and "subtrees/r/z/x/y.subtree": two roots of 180° with implicit children, named as in TileFormat::kGlb;
/// for a local grid one, in a box, with the transform of facts.plane. A tile's geometric error is a power of two below
/// its root's, and no less than what is proven of its level. REQUIRES: both roots are there, and each other tile's
/// parent.
std::vector<NamedFile> encode_tileset(const PyramidPlan& plan, const PyramidReport& report, const FactsByTile& tiles,
                                      const LayerFacts& facts = {});

}  // namespace scarp

#pragma GCC visibility pop
