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
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/pyramid.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"

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

/// Suffix for lengths of a set with these LayerFacts::units: " m", or nothing where they are no metres.
inline const char* unit_behind(std::string_view units) { return units.empty() || units == "metre" ? " m" : ""; }

/// The bytes of layer.json, for "quantized-mesh-1.0": the file that clients ask for first. Without report.levels it
/// holds no errors of tiles: those of tiles that are not made yet.
std::vector<std::uint8_t> encode_layer_json(const PyramidPlan& plan, const PyramidReport& report,
                                            const LayerFacts& facts);

}  // namespace scarp

#pragma GCC visibility pop
