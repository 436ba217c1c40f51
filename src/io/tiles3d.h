// 3D Tiles 1.1 of terrain: the tiles of a pyramid as GLB files, and the metadata files that list them. CesiumJS can use
// a set as terrain (Cesium3DTilesTerrainProvider) or, like other 3D Tiles clients, as an ordinary tileset.
//
// POSITIONS are earth-centred and lie on one lattice per level: multiples of a power of two, at most 1/32 of the
// level's max error. A vertex shared by neighbouring tiles has the same doubles in both. On the plane of a local grid,
// positions are metres from the raster's centre and lie on its samples.
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

namespace scarp::io {

/// Steps of a level's lattice in metres along the three axes: as fine as 16 bits allow in a tile, but at least 1/256 of
/// the level's max error. On a local grid's plane the axes are east, north and up.
std::array<double, 3> lattice_steps(const PyramidPlan& plan, int z);

/// The largest shift of a vertex by the lattice, in metres: √3/2 of the step, 0 on a plane. The sum of it and
/// TerrainTile::bound() bounds the distance in space between a node and the triangles.
double lattice_error(const PyramidPlan& plan, int z);

/// The facts about a tile that clients need in addition to its mesh.
struct TileFacts {
  /// Height range of the triangles, in metres above the ellipsoid or the plane. It includes the depth of flat triangles
  /// below the curved surface.
  double min_height = 0, max_height = 0;
  std::array<double, 4> sphere{};  ///< contains the triangles: centre, radius
  /// Horizon occlusion point, in units of the ellipsoid's axes: a viewer who does not see it sees no part of the tile.
  /// Always finite; far away for tiles that the horizon cannot hide. (0, 0, 0) on the plane of a local grid, which has
  /// no horizon.
  std::array<double, 3> horizon_point{};

  bool has_horizon() const { return horizon_point != std::array<double, 3>{}; }

  friend bool operator==(const TileFacts&, const TileFacts&) = default;
};

struct EarthTile {
  std::array<double, 3> steps{1, 1, 1};               ///< metres, along each axis; all equal on a globe
  std::array<std::int64_t, 3> origin{};               ///< in steps: x towards 0° E, z towards the north pole
  std::vector<std::array<std::uint32_t, 3>> offsets;  ///< from the origin, in steps, below 2^24
  std::vector<std::array<double, 3>> normals;         ///< normals of unit length
  std::vector<std::array<double, 2>> places;          ///< position in the tile, 0 … 1 from west, from north
  std::vector<std::uint32_t> triangles;               ///< counter-clockwise seen from outside
  /// Vertices on the edges, clockwise around the tile seen from outside, as CesiumJS expects them.
  std::vector<std::uint32_t> west, north, east, south;
  /// The skirt's lower ends, in steps from the origin: one below each vertex of west, north, east and south. Empty on
  /// an edge without a neighbour: at a pole, and at the end of a local grid's raster.
  std::array<std::vector<std::array<std::uint32_t, 3>>, 4> feet;
  TileFacts facts;  ///< without the skirt
};

/// Depth of skirts in metres: 5 times the level's geometric error, as in CesiumJS and cesium-native for terrain, or 5
/// times its max error if larger. This suffices next to tiles two levels coarser.
double skirt_depth(const PyramidPlan& plan, int z);

/// Depends only on the tile and the plan, not on the machine's mathematics library.
EarthTile place_on_earth(const TerrainTile& tile, const PyramidPlan& plan);

struct TileGlbOptions {
  /// Use EXT_meshopt_compression (version 0 of the codec) and KHR_mesh_quantization. Positions then have 16 bits if the
  /// offsets fit, and normals have 8 bits. Ignored in builds without libmeshoptimizer. DEFAULT: true.
  bool compress = true;
  std::optional<TileTexture> texture = std::nullopt;  ///< DEFAULT: none; the ground then has one colour.
};

/// The bytes of a GLB file: one node with a matrix, and one mesh. Its first primitive is the surface, with its edges in
/// CESIUM_tile_edges, clockwise. CesiumJS uses only this primitive for terrain. The second one is the skirt, as its
/// extras declare. The skirt's vertices are pairs: one on an edge and one below it. The y axis points up, as glTF
/// requires; 3D Tiles clients rotate positions back. Texture coordinates are multiples of 1/65535. asset.extras holds
/// the facts. Fails as encode_glb() does.
Result<std::vector<std::uint8_t>> encode_tile_glb(const EarthTile& tile, const TileGlbOptions& options = {});

/// The facts of a tile written by encode_tile_glb(). Fails with kInput for other files.
Result<TileFacts> read_tile_facts(std::span<const std::uint8_t> glb);

/// A terrain tile in a GLB file, as 3D Tiles clients decode it: rotated back to the earth's axes.
struct TileGlb {
  std::vector<std::array<double, 3>> positions;  ///< metres; shared vertices are the same doubles in Scarp's tiles
  std::vector<std::array<double, 3>> normals;    ///< empty, or one per vertex
  std::vector<float> uvs;                        ///< empty, or two per vertex: its position in `image`, from the top
                                                 ///< left
  GlbImage image;                                ///< empty if absent
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> west, south, east, north;  ///< edges of CESIUM_tile_edges
  std::vector<std::array<double, 3>> skirt;             ///< vertex pairs: on an edge, and below it; not part of the
                                                        ///< surface
  std::vector<std::uint32_t> skirt_triangles;
  double step = 0;  ///< metres: the file's largest step between positions; 0 for single precision
  TileFacts facts;
};

/// Fails with kInput unless Scarp wrote the file; accepts untrusted bytes.
Result<TileGlb> decode_tile_glb(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

/// The facts of a set's tiles, by level, row and column.
using FactsByTile = std::map<std::tuple<int, std::uint32_t, std::uint32_t>, TileFacts>;

struct NamedFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// tileset.json and "subtrees/r/z/x/y.subtree": two roots of 180° with implicit children, named as in TileFormat::kGlb.
/// A local grid has one root, in a box, with the transform of facts.plane. A tile's geometric error is that of its root
/// divided by a power of two, and at least its level's proven error. REQUIRES: all roots exist, and the parents of all
/// other tiles.
std::vector<NamedFile> encode_tileset(const PyramidPlan& plan, const PyramidReport& report, const FactsByTile& tiles,
                                      const LayerFacts& facts = {});

}  // namespace scarp::io

#pragma GCC visibility pop
