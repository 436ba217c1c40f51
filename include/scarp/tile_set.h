// Write, read and check sets of tiles: folders and one-file containers. All containers hold the same things: tiles,
// each a few bytes under its TileId, and other files by name, such as "layer.json". A set that is written to one
// container and read from it is the same set, byte for byte.
//
// The container is chosen by the ending of the path:
//   .pmtiles         PMTiles 3: one file, of which clients read ranges
//   .mbtiles         MBTiles 1.3: a database of SQLite
//   .3tz             3D Tiles Archive 1.3: ZIP, not compressed
//   (none of these)  a folder: each tile and each file under its name; any web server can serve it
// docs/tiles.md describes what each holds.
//
// Example:
//     SCARP_TRY(const auto& set, scarp::open_tile_set("hills.pmtiles"));
//     SCARP_TRY(const auto& check, scarp::check_tiles(*set));
//     for (const scarp::TileFault& fault : check.described) std::printf("%s\n", fault.sentence.c_str());
//     std::printf("%zu levels, sound: %d\n", set->tiles().size(), check.holds());
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

enum class TileFormat {
  kQuantizedMesh,  ///< named "z/x/y.terrain", y from the south
  kGlb,            ///< named "r/z/x/y.glb", where x counts within root r: x of the TileId is r · 2^z + x
};

/// The name of a tile where tiles are files, by TileFormat.
std::string tile_name(TileFormat format, TileId id);
/// The reverse; nothing for other names, and for tiles that no grid has.
std::optional<TileId> find_tile_id(TileFormat format, std::string_view name);

/// Writes a set of tiles into its container. One thread at a time.
class TileSetWriter {
 public:
  /// An unfinished set is removed.
  virtual ~TileSetWriter() = default;
  /// The bytes as they are kept: readers get the same. Tiles may come in any order. REQUIRES: each id once, of the
  /// grid. Fails with kOutput.
  virtual Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) = 0;
  /// Fails with kOutput. REQUIRES: each name once; it is a relative path of plain parts, no tile's name, and one of
  /// "layer.json", "tileset.json" and "subtrees/….subtree" if Scarp is to know the set as its own.
  virtual Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) = 0;
  /// Gives the set its name. Fails with kOutput. REQUIRES: called once, at the end.
  virtual Result<void> finish() = 0;
};

/// Fails with kUsage for a name of neither folder nor container: that of a mesh, an image, one tile. A folder that is
/// there may have any name, and so may one that ends with a slash.
Result<void> check_set_name(const std::string& path);
/// A set under a temporary name in the folder of `path`, until finish(). A folder's is ".scarp-tiles-…"; the next set
/// of the same name removes those that killed processes of this machine left. One file needs the room of the set twice
/// until then; memory: 24 bytes a tile, with PMTiles twice that. The bytes of the finished set do not depend on the
/// order of its tiles and files. Fails with kOutput where `path` exists, unless it is an empty folder and the set is to
/// be one, or `overwrite` is true and it is a set of Scarp's tiles with nothing else in it: "layer.json" or
/// "tileset.json" show whose it is. Fails with kOutput where nothing can be made, too, and as check_set_name().
Result<std::unique_ptr<TileSetWriter>> create_tile_set(const std::string& path, TileFormat format, bool overwrite);

/// Reads a finished set. Several threads may read at once.
class TileSetReader {
 public:
  virtual ~TileSetReader() = default;
  virtual TileFormat format() const = 0;
  /// By level: rows and columns of its tiles, y · 2^32 + x, sorted, as PyramidReport::tiles.
  virtual const std::vector<std::vector<std::uint64_t>>& tiles() const = 0;
  /// Names of the other files, sorted.
  virtual std::vector<std::string> files() const = 0;
  /// The bytes as they are kept, compressed or not. Fails with kInput where there is no such tile, or the container is
  /// damaged.
  virtual Result<std::vector<std::uint8_t>> read_tile(TileId id) const = 0;
  virtual Result<std::vector<std::uint8_t>> read_file(const std::string& name) const = 0;
  /// True if the container declares that all tiles are in gzip; nothing if it declares nothing about that.
  virtual std::optional<bool> says_gzip() const { return std::nullopt; }
  /// Sentences: false statements of the container about itself, for other readers than this one. Reads its indexes
  /// whole.
  virtual std::vector<std::string> find_faults() const { return {}; }
};

/// Sets of other programs open as well: folders of "z/x/y.terrain", whether compressed or not, and with tiles missing.
/// Fails with kInput for what is no set of tiles, is damaged, or was cut off; never trusts a length or an offset in it.
/// Memory: 8 bytes a tile, PMTiles 32, .3tz some 150; never more than a multiple of the set's size.
Result<std::unique_ptr<TileSetReader>> open_tile_set(const std::string& path);

/// The grid of tiles that a set's layer.json or tileset.json names; else the geographic one.
TileGrid find_grid(const TileSetReader& set);

/// The value of --vertical when the set was made, from its layer.json or tileset.json; empty if they do not hold it.
std::string find_vertical(const TileSetReader& set);

/// The position of a local grid's plane on the globe.
struct PlaneOnGlobe {
  /// From metres east, north and up of the sample at the raster's centre, as LocalRaster has it, to the earth's centre:
  /// 4 × 4, by columns. It is exact at the centre, where it has the projection's turn and scale.
  std::array<double, 16> transform{};
  std::string crs;                  ///< CRS of the raster, as RasterInfo::crs
  double convergence = 0;           ///< degrees from true north to the raster's, clockwise
  double scale_x = 1, scale_y = 1;  ///< scale of the projection there: metres of the plane to one on the ground
  /// Largest distance in metres from where the transform puts the raster to where it lies, along the ground and in
  /// height. Its causes are the earth's curve, and scale and turn away from the centre.
  double off_along = 0, off_height = 0;

  friend bool operator==(const PlaneOnGlobe&, const PlaneOnGlobe&) = default;
};

/// The facts that a set declares in addition to the tiles.
struct LayerFacts {
  std::string name = "terrain";
  std::string description;
  std::string attribution;
  std::string heights_above;  ///< the zero of the source's heights, in words; those of tiles: the ellipsoid
  std::string vertical;       ///< Datum::vertical as an option names it; empty for kAuto and kGeoid
  std::string body;           ///< whose ellipsoid, as RasterOnGlobe::body
  std::string units;          ///< units of a local grid's cells, like RasterOnPlane::units; empty with others
  std::optional<PlaneOnGlobe> plane = std::nullopt;  ///< plane of a local grid that has a position on the globe
  std::string version = {};  ///< changes with any tile: clients ask for tiles with it, past old copies; sinks find it
};

/// The suffix of lengths in a set with these LayerFacts::units: " m" for metres and for unnamed units, else empty.
inline const char* unit_behind(std::string_view units) { return units.empty() || units == "metre" ? " m" : ""; }

/// The bytes of layer.json, for "quantized-mesh-1.0": the file that clients ask for first. Without report.levels it
/// holds no errors of tiles: those of tiles that are not made yet.
std::vector<std::uint8_t> encode_layer_json(const PyramidPlan& plan, const PyramidReport& report,
                                            const LayerFacts& facts);

// Checks of finished sets of tiles, Scarp's or another program's: what clients will decode is compared with what the
// set declares about itself, tile with tile, and with the nodes that it was made of.
//
//   container     statements of the container's own header, index and tables are true
//   availability  each tile that is announced is there, each that is there is announced, with its parent; so are the
//                 roots
//   file          each tile can be decoded, all its indices are those of vertices
//   coverage      triangles cover the tile once: none is turned over, no gap, no vertex in the middle of an edge
//   edge list     the lists of the four edges name all vertices there, and no others
//   border        neighbours decode to the same vertices, heights in single precision, and normals, at the four tiles
//                 of a corner, around the antimeridian and at the poles, too
//   header        heights, bounding sphere and centre hold all vertices
//   horizon       no camera sees a vertex of a tile that its horizon point hides from it
//   bound         no node under a tile is farther from its triangles than the set promises of the level; no sample of
//                 the source either
//   tileset       statements of tileset.json about its roots: volumes, transform, refinement, errors, levels; with
//                 nodes, too, that a local grid lies where its source does
//
// Nothing here knows how tiles are made: the room src/check may not include src/tiles.

enum class TileFaultKind {
  kContainer,
  kAvailability,
  kFile,
  kCoverage,
  kEdgeList,
  kBorder,
  kHeader,
  kHorizon,
  kBound,
  kTileset
};
inline constexpr std::size_t kTileFaultKinds = 10;
/// "container", "edge list", …
const char* name_of(TileFaultKind kind);

/// The position of a local grid's raster on the globe.
struct CheckedPlace {
  /// Longitude and latitude in degrees, and the metres above the ellipsoid that its heights count from, of a place in
  /// cells east and north of the south-western sample; not finite where it has none.
  std::function<std::array<double, 3>(double east, double north)> find;
  Geodetic ellipsoid = {};
};

/// The nodes that a set was made of.
struct CheckedNodes {
  const NodeSource* source = nullptr;     ///< heights above the ellipsoid; borrowed
  DegreeBox covered{-180, -90, 180, 90};  ///< beyond it no node has a height
  /// Cells a side of a tile of the set's finest level. DEFAULT (0): the number in the set's metadata, else 128.
  int cells = 0;
  /// Height of nodes without a height. DEFAULT: the height in the set's metadata, else 0.
  std::optional<float> background = std::nullopt;
  /// DEFAULT: none, the raster has no place on the globe.
  std::optional<CheckedPlace> place = std::nullopt;
};

struct TileCheckOptions {
  CheckedNodes nodes = {};  ///< DEFAULT: none, bounds are not measured
  /// Ellipsoid of the globe. DEFAULT: the one in the set's metadata, else WGS 84.
  std::optional<Geodetic> ellipsoid = std::nullopt;
  std::optional<TileGrid> grid = std::nullopt;  ///< DEFAULT: of the projection that layer.json names, else geographic.
  std::size_t most_faults = 1;                  ///< number of faults described, of each kind
  Run run = {};                                 ///< threads and progress, passes "check" and "nodes"
};

struct TileFault {
  TileFaultKind kind = TileFaultKind::kContainer;
  std::string sentence;  ///< names the tile
};

/// The findings on a level.
struct CheckedLevel {
  std::uint64_t tiles = 0, triangles = 0;
  std::uint64_t edges = 0, edges_apart = 0;      ///< number of edges that two tiles share, or a pole; number of them
                                                 ///< that differ
  std::uint64_t corners = 0, corners_apart = 0;  ///< number of corners that tiles share across, likewise
  double gap = 0;                                ///< the largest between two edges, metres
  double sag = 0;                                ///< depth of the flat triangles below the curve, metres
  std::optional<double> promised_node_error, promised_bound, promised_source_error;  ///< values that the set itself
                                                                                     ///< declares
  /// With nodes: the largest |mesh − node| where edges are straight on the map, and the largest distance in space.
  std::optional<double> node_error, distance;
  /// With nodes whose source shows its samples: the largest |mesh − sample|, each at its own place, of those that all
  /// four nodes around have heights.
  std::optional<double> source_error;
};

struct TileCheck {
  TileFormat format = TileFormat::kQuantizedMesh;
  std::string units;                 ///< units of a local grid's cells, like LayerFacts::units: lengths here are in
                                     ///< these
  std::vector<CheckedLevel> levels;  ///< 0 … the finest
  std::array<std::uint64_t, kTileFaultKinds> faults{};  ///< by kind
  std::vector<TileFault> described;                     ///< in the order of the kinds
  std::uint64_t nodes = 0;                              ///< places where a tile was compared with a node

  std::uint64_t count() const;
  bool holds() const { return count() == 0; }
};

/// Checks all of a set. The result does not depend on the number of threads. Fails with kCancelled, as the nodes'
/// source does, and with kUsage for cells that make no lattice of the set's levels; faults of the set are in the
/// result.
///
/// Memory: that of the reader, edges of a row of tiles (some 2 kB a tile), 200 bytes a tile for 3D Tiles, and with
/// nodes 70 MB. Cost: each tile is decoded once, with nodes twice; each node is read once, and judged on each level, as
/// are the samples.
Result<TileCheck> check_tiles(const TileSetReader& set, const TileCheckOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
