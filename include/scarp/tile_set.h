// Write, read and check tile sets in folders and one-file containers. All containers hold tiles by TileId, and other
// files by name, such as "layer.json". Reading returns the written bytes.
//
// The container is chosen by the ending of the path:
//   .pmtiles         PMTiles 3: one file; clients read ranges of it
//   .mbtiles         MBTiles 1.3: an SQLite database
//   .3tz             3D Tiles Archive 1.3: ZIP, not compressed
//   (none of these)  a folder: each tile and each file under its name; any web server can serve it
// docs/tiles.md describes the contents of a set.
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

/// The name of a tile as a file, by TileFormat.
std::string tile_name(TileFormat format, TileId id);
/// The tile with this file name; nothing for other names, and for tiles outside of all grids.
std::optional<TileId> find_tile_id(TileFormat format, std::string_view name);

/// Writes a set of tiles into its container. Only one thread at a time may use it.
class TileSetWriter {
 public:
  /// Removes an unfinished set.
  virtual ~TileSetWriter() = default;
  /// Adds a tile; readers get the same bytes. Tiles may be added in any order. REQUIRES: each id belongs to the grid
  /// and is added once. Fails with kOutput.
  virtual Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) = 0;
  /// Adds another file. Fails with kOutput. REQUIRES: each name is added once, is a relative path of plain parts, and
  /// is not a tile's name. Scarp recognises a set as its own only if all names are "layer.json", "tileset.json" or
  /// "subtrees/….subtree".
  virtual Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) = 0;
  /// Gives the set its final name. Fails with kOutput. REQUIRES: called once, at the end.
  virtual Result<void> finish() = 0;
};

/// Fails with kUsage for a name that fits neither a folder nor a container, such as that of a mesh, an image or a tile.
/// Names that end with a slash and names of existing folders are always folders.
Result<void> check_set_name(const std::string& path);
/// Creates a set. Until finish(), it has a temporary name in the folder of `path`. A folder is first named
/// ".scarp-tiles-…"; the next set of the same name removes such folders of killed processes on this machine. One-file
/// containers need twice the space of the set until finish(). Memory: 24 bytes a tile, with PMTiles twice that. The
/// bytes of the finished set do not depend on the order of its tiles and files. Fails with kOutput if nothing can be
/// created, and if `path` exists, with two exceptions: an empty folder for a set in a folder and, with `overwrite`, a
/// set of Scarp (recognised by "layer.json" or "tileset.json") with nothing else in it. Also fails as check_set_name()
/// does.
Result<std::unique_ptr<TileSetWriter>> create_tile_set(const std::string& path, TileFormat format, bool overwrite);

/// Reads a finished set. Several threads may read at once.
class TileSetReader {
 public:
  virtual ~TileSetReader() = default;
  virtual TileFormat format() const = 0;
  /// For each level, y · 2^32 + x of its tiles, sorted, as in PyramidReport::tiles.
  virtual const std::vector<std::vector<std::uint64_t>>& tiles() const = 0;
  /// Names of the other files, sorted.
  virtual std::vector<std::string> files() const = 0;
  /// The bytes as stored, compressed or not. Fails with kInput if there is no such tile, or the container is damaged.
  virtual Result<std::vector<std::uint8_t>> read_tile(TileId id) const = 0;
  virtual Result<std::vector<std::uint8_t>> read_file(const std::string& name) const = 0;
  /// True if the container declares that all tiles are compressed with gzip; std::nullopt if it does not declare this.
  virtual std::optional<bool> says_gzip() const { return std::nullopt; }
  /// Describes the container's false declarations about itself, in sentences; other readers may rely on these
  /// declarations. Reads all its indexes.
  virtual std::vector<std::string> find_faults() const { return {}; }
};

/// Opens a tile set made by Scarp or another program, such as a folder of "z/x/y.terrain" files. Tiles may be
/// compressed or missing. Fails with kInput if the path is not a tile set, or the set is damaged or truncated. Checks
/// each length and offset in it. Memory: 8 bytes a tile, PMTiles 32, .3tz some 150; never more than a multiple of the
/// set's size.
Result<std::unique_ptr<TileSetReader>> open_tile_set(const std::string& path);

/// The grid of tiles declared by a set's layer.json or tileset.json; else the geographic one.
TileGrid find_grid(const TileSetReader& set);

/// The value of --vertical when the set was made, from its layer.json or tileset.json; empty if missing there.
std::string find_vertical(const TileSetReader& set);

/// The position of a local grid's plane on the globe.
struct PlaneOnGlobe {
  /// Matrix, 4 × 4 by columns, from metres east, north and up of the raster's centre sample (LocalRaster) to
  /// earth-centred metres. Exact at the centre, with the rotation and scale of the projection there.
  std::array<double, 16> transform{};
  std::string crs;                  ///< CRS of the raster, as RasterInfo::crs
  double convergence = 0;           ///< degrees from true north to the raster's north, clockwise
  double scale_x = 1, scale_y = 1;  ///< scale of the projection at the centre: metres on the plane per metre on
                                    ///< the ground
  /// Largest distance in metres between the transformed and the true position of the raster, along the ground and in
  /// height. Its causes are the earth's curvature, and the change of scale and rotation away from the centre.
  double off_along = 0, off_height = 0;

  friend bool operator==(const PlaneOnGlobe&, const PlaneOnGlobe&) = default;
};

struct LayerFacts {
  std::string name = "terrain";
  std::string description;
  std::string attribution;
  std::string heights_above;  ///< the zero of the source's heights, in words (that of the tiles is the ellipsoid)
  std::string vertical;       ///< Datum::vertical as an option value; empty for kAuto and kGeoid
  std::string body;           ///< see RasterOnGlobe::body
  std::string units;          ///< units of a local grid's cells, as RasterOnPlane::units; else empty
  std::optional<PlaneOnGlobe> plane = std::nullopt;  ///< plane of a local grid with a position on the globe
  std::string version = {};  ///< set by sinks; changes if any tile changes. Clients add it to requests to bypass old
                             ///< cached copies
};

/// The suffix of lengths for LayerFacts::units: " m" for metres and for unnamed units, else empty.
inline const char* unit_behind(std::string_view units) { return units.empty() || units == "metre" ? " m" : ""; }

/// Returns the bytes of layer.json, for "quantized-mesh-1.0": the file that clients request first. Without
/// report.levels, errors of tiles are omitted, since the tiles do not exist yet.
std::vector<std::uint8_t> encode_layer_json(const PyramidPlan& plan, const PyramidReport& report,
                                            const LayerFacts& facts);

// Checks of finished tile sets of Scarp or other programs. Decoded tiles are compared with the set's declarations, with
// each other, and with the nodes from which the set was made.
//
//   container     the container's header, index and tables are correct
//   availability  each announced tile exists, each existing tile and its parent are announced; all roots exist
//   file          each tile can be decoded, and all its indices refer to vertices
//   coverage      triangles cover the tile once: no flipped triangle, no gap, no vertex in the middle of an edge
//   edge list     the lists of the four edges contain exactly the vertices on them
//   border        neighbours decode to the same vertices, heights in single precision, and normals, also where four
//                 tiles meet, around the antimeridian and at the poles
//   header        heights, bounding sphere and centre fit all vertices
//   horizon       no camera sees a vertex that its tile's horizon point hides
//   bound         no node under a tile, and no sample of the source, is farther from its triangles than the set
//                 declares for the level
//   tileset       declarations of tileset.json about its roots are correct: volumes, transform, refinement, errors,
//                 levels; with nodes, also the position of a local grid
//
// The checks share no code with the making of tiles: src/check may not include src/tiles.

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
  /// Returns longitude and latitude in degrees, and the zero of the heights in metres above the ellipsoid; not finite
  /// where undefined. The position is given in cells east and north of the south-western sample.
  std::function<std::array<double, 3>(double east, double north)> find;
  Geodetic ellipsoid = {};
};

/// The nodes from which a set was made.
struct CheckedNodes {
  const NodeSource* source = nullptr;     ///< heights above the ellipsoid; borrowed
  DegreeBox covered{-180, -90, 180, 90};  ///< no node outside has a height
  /// Cells a side of a tile of the set's finest level. DEFAULT (0): the number in the set's metadata, else 128.
  int cells = 0;
  /// Height for nodes without a height. DEFAULT: the one in the set's metadata, else 0.
  std::optional<float> background = std::nullopt;
  /// DEFAULT: none, the raster has no position on the globe.
  std::optional<CheckedPlace> place = std::nullopt;
};

struct TileCheckOptions {
  CheckedNodes nodes = {};  ///< DEFAULT: none, bounds are not measured
  /// Ellipsoid of the globe. DEFAULT: the one in the set's metadata, else WGS 84.
  std::optional<Geodetic> ellipsoid = std::nullopt;
  std::optional<TileGrid> grid = std::nullopt;  ///< DEFAULT: by the projection in layer.json, else geographic.
  std::size_t most_faults = 1;                  ///< max number of described faults of each kind
  Run run = {};                                 ///< threads and progress, passes "check" and "nodes"
};

struct TileFault {
  TileFaultKind kind = TileFaultKind::kContainer;
  std::string sentence;  ///< names the tile
};

struct CheckedLevel {
  std::uint64_t tiles = 0, triangles = 0;
  std::uint64_t edges = 0, edges_apart = 0;      ///< edges shared by two tiles, or by a tile and a pole; number of
                                                 ///< these that differ
  std::uint64_t corners = 0, corners_apart = 0;  ///< corners shared by diagonal tiles; number of these that differ
  double gap = 0;                                ///< the largest gap between two edges, metres
  double sag = 0;                                ///< depth of flat triangles below the earth's curve, metres
  std::optional<double> promised_node_error, promised_bound, promised_source_error;  ///< values declared by the set
  /// With nodes: the largest |mesh − node|, with edges that are straight on the map, and the largest distance in space.
  std::optional<double> node_error, distance;
  /// With nodes whose source has samples: the largest |mesh − sample|, each at its own position, over samples whose
  /// four surrounding nodes have heights.
  std::optional<double> source_error;
};

struct TileCheck {
  TileFormat format = TileFormat::kQuantizedMesh;
  std::string units;                 ///< units of lengths here: those of a local grid's cells, as LayerFacts::units
  std::vector<CheckedLevel> levels;  ///< 0 … the finest
  std::array<std::uint64_t, kTileFaultKinds> faults{};  ///< by kind
  std::vector<TileFault> described;                     ///< in the order of the kinds
  std::uint64_t nodes = 0;                              ///< comparisons of a tile with a node

  std::uint64_t count() const;
  bool holds() const { return count() == 0; }
};

/// Checks a whole set. The result does not depend on the number of threads. Fails as the nodes' source does, with
/// kUsage for `cells` that do not fit the set's levels, and with kCancelled. Faults of the set are listed in the
/// result.
///
/// Memory: that of the reader, edges of a row of tiles (some 2 kB a tile), 200 bytes a tile for 3D Tiles, and with
/// nodes 70 MB. Cost: each tile is decoded once, or twice with nodes; each node is read once, and nodes and samples are
/// judged on each level.
Result<TileCheck> check_tiles(const TileSetReader& set, const TileCheckOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
