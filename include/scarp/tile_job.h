// Make sets of tiles of raster files, in one process, or in many, on one machine or on several that share a folder.
//
//   plan     write_tile_plan(): everything that a tile depends on, in a file
//   run      each process makes blocks of the plan and keeps them in parts: make_parts()
//   finish   finish_parts(): the levels above the blocks, and the set
//
// Nothing but the plan and the parts passes between processes. A block that is in a part is never made again, so a run
// that was interrupted resumes where it was. The set is that of make_pyramid(), byte for byte, whoever made its blocks.
//
// After a change of the sources a new plan with the settings of the one before reuses its parts: blocks whose nodes are
// unchanged are kept.
//
// Example:
//     SCARP_TRY(const auto& raster, scarp::GlobeRaster::open(scarp::find_mosaics({"dem.tif"}), {.with_range = true},
//                                                            {.vertical = scarp::Vertical::kEgm96}));
//     SCARP_TRY(const auto& plan, scarp::plan_pyramid(raster->facts(), {.grid = raster->grid(128)}));
//     constexpr scarp::TileFormat kFormat = scarp::TileFormat::kQuantizedMesh;
//     SCARP_TRY(const auto& set, scarp::create_tile_set("terrain.pmtiles", kFormat, true));
//     const auto sink = scarp::make_tile_sink(kFormat, *set, plan);
//     SCARP_TRY(auto&& report, scarp::make_pyramid(plan, raster->nodes(), *sink));
//     SCARP_RETURN_IF_ERROR(sink->put_files(report, {}));
//     SCARP_RETURN_IF_ERROR(set->finish());
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

// The place of a raster on the globe, and the zero of its heights.

/// The zero of heights.
enum class Vertical {
  kAuto,       ///< the zero that the raster's CRS names
  kEllipsoid,  ///< the ellipsoid, as GPS gives them
  kEgm96,      ///< the geoid EGM96: the sea, as egm96() has it
  kEpsg,       ///< a vertical CRS of EPSG's, by PROJ and its grids
  kGeoid,      ///< a surface that a raster holds
  kNone,       ///< unknown: heights are used as they are, as if above the ellipsoid
};

/// The user's statement about a raster's heights and about its globe.
struct Datum {
  Vertical vertical = Vertical::kAuto;
  int epsg = 0;            ///< code for kEpsg: 3855 is EGM2008
  std::string geoid = {};  ///< file for kGeoid: a raster of the surface's heights above the ellipsoid, in metres (GTX,
                           ///< GeoTIFF, …)
  /// In place of the CRS's: longitude and latitude are the raster's own, on this one.
  std::optional<Geodetic> ellipsoid = std::nullopt;
};

/// The position of a raster on the globe.
struct RasterOnGlobe {
  RasterPlace place;
  std::shared_ptr<const PointTransform> to_degrees;  ///< null where place.from_degrees is
  std::string degrees;                               ///< the CRS of longitude and latitude, as RasterInfo::crs
  Geodetic ellipsoid;
  std::string body;                        ///< whose ellipsoid, in the CRS's words; empty for WGS 84
  std::shared_ptr<const HeightZero> zero;  ///< zero of the heights; null where they are above the ellipsoid
  double zero_reach = 0;                   ///< metres that the zero is from the ellipsoid, at most
  std::string vertical;                    ///< the zero of the heights, in words
};

/// A raster on a plane.
struct RasterOnPlane {
  double cell_x = 1, cell_y = 1;
  std::string units;                  ///< unit of cell_x and cell_y: "metre", "cell", or "unit of the raster's x and y"
  std::string vertical;               ///< the zero of the heights, in words
  std::optional<PlaneOnGlobe> globe;  ///< nothing for a raster that has no place there
  Geodetic ellipsoid;                 ///< ellipsoid that the plane touches, with `globe`
  std::string body;                   ///< whose, as RasterOnGlobe::body
  std::vector<std::string> warnings;  ///< warns if the plane lies far from its place on the globe
  /// Likewise: where each sample lies.
  std::optional<RasterOnGlobe> samples = std::nullopt;
};

// From the tiles of a pyramid to the files of a set: encoders, textures and sinks.

/// The encoder of a format. quantized-mesh is in gzip: servers must send "Content-Encoding: gzip" with such tiles.
/// Borrows the plan.
TileEncoder make_tile_encoder(TileFormat format, const PyramidPlan& plan);

/// Tiles of a format into a set.
class TileSetSink : public TileSink {
 public:
  /// Borrows both. DEFAULT encoder: that of the format.
  TileSetSink(TileSetWriter& writer, TileFormat format, const PyramidPlan& plan, TileEncoder encoder = {});

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override;
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override;
  /// A hash of all tiles put so far, whatever their order: 16 hexadecimal digits.
  std::string version() const;
  /// Writes the metadata file for clients: layer.json. Once, after all tiles. Fails with kOutput. Adds to the report's
  /// bounds what the format adds to the tiles'.
  virtual Result<void> put_files(PyramidReport& report, LayerFacts facts);

 protected:
  TileSetWriter& writer() { return *writer_; }
  const PyramidPlan& plan() const { return *plan_; }

 private:
  TileSetWriter* writer_;
  const PyramidPlan* plan_;
  TileEncoder encoder_;
  std::uint64_t hash_ = 0;
};

/// The sink of a format. Borrows both. DEFAULT encoder: that of the format.
std::unique_ptr<TileSetSink> make_tile_sink(TileFormat format, TileSetWriter& writer, const PyramidPlan& plan,
                                            TileEncoder encoder = {});

struct TileJob;

/// Rasters in the order of their priority, open as one source of nodes on the globe: a node has the height of the first
/// that has one there. Each has a CRS, cells, a nodata value and a datum of its own. Or one raster on a plane.
class GlobeRaster {
 public:
  /// `mosaics`: at least one; the rasters of each lie on one grid, as find_mosaics() puts them together. Reads them, or
  /// keeps them in their files where memory does not hold them, as open_height_field(); options.crs and
  /// options.view.more are not read. Fails as that and place_on_globe() do; with kUsage for options.view of several
  /// mosaics, and where the datum is another one than a raster's CRS declares; with kInput for several planets.
  ///
  /// `grid`: nothing: what suits the first raster, grid_for(). With a local one there is one mosaic, kUsage else, which
  /// place_on_plane() places.
  static Result<std::unique_ptr<GlobeRaster>> open(const std::vector<std::vector<std::string>>& mosaics,
                                                   const ReadOptions& options, const Datum& datum,
                                                   std::optional<GridKind> grid = GridKind::kGeographic);
  GlobeRaster(const GlobeRaster&) = delete;
  GlobeRaster& operator=(const GlobeRaster&) = delete;
  ~GlobeRaster();

  /// Heights above the ellipsoid. Lives as long as this, or until water is added.
  const NodeSource& nodes() const;
  /// From now on nodes() have the plan's water, if it has any. REQUIRES: called once, of a plan for this raster.
  void add_waters(const PyramidPlan& plan);
  /// For plan_pyramid(). REQUIRES: opened with options.with_range.
  std::vector<SourceFacts> facts() const;
  /// Its grid of tiles, with so many cells a side of one of the finest level.
  TileGrid grid(int cells) const;
  const std::optional<RasterOnPlane>& plane() const;  ///< with a local grid
  const RasterInfo& info() const;                     ///< facts about the first raster
  const RasterOnGlobe& place() const;                 ///< position of the first raster
  VoidCount voids() const;                            ///< RasterInfo::voids of all together
  std::string heights_above() const;                  ///< RasterOnGlobe::vertical of all, each once
  std::vector<std::string> warnings() const;          ///< RasterInfo::warnings of all, and of find_waters()

 private:
  friend Result<void> find_waters(TileJob& job, GlobeRaster& raster);
  struct Impl;
  explicit GlobeRaster(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The facts that distinguish a file from a later one of the same name.
struct FileStamp {
  std::string path;  ///< absolute, where it names a file
  std::uint64_t size = 0;
  std::int64_t changed = 0;   ///< nanoseconds since 1970; both 0 for what is no file, such as a URL
  std::uint64_t content = 0;  ///< a hash of its bytes; 0: they were not read

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
/// The stamp of an existing file; else the path alone.
FileStamp stamp_of(const std::string& path);

/// The estimated cost of making a set, from a few tiles that were made as a trial.
struct TileEstimate {
  std::uint64_t blocks = 0;        ///< number that may have heights
  std::uint64_t finest_tiles = 0;  ///< number on the finest level
  std::uint64_t tiles = 0;         ///< number on all levels
  std::uint64_t bytes = 0;         ///< size of the tiles, as kept
  double core_seconds = 0;         ///< on this machine
  std::uint64_t memory = 0;        ///< bytes of a process with one thread, without the raster
  std::uint64_t parts = 0;         ///< bytes of the parts, until the set is finished
};

/// Vector files of water, as read_lines() accepts them: FILE or FILE:LAYER.
struct WaterFiles {
  std::vector<std::string> lakes, rivers;
  double percentile = 5;  ///< like WaterOptions::percentile

  bool is_empty() const { return lakes.empty() && rivers.empty(); }
};

/// An image draped over the tiles, of 3D Tiles alone.
struct TileDrape {
  std::vector<FileStamp> files;  ///< the image, and others that it is made of
  ImageFormat format = ImageFormat::kJpeg;

  const std::string& path() const { return files.front().path; }
};
/// The stamps of an image.
TileDrape stamp_drape(const std::string& path, ImageFormat format);

/// All that a set depends on.
struct TileJob {
  std::vector<FileStamp> rasters;      ///< in the order of their priority
  std::vector<std::uint32_t> mosaics;  ///< how many of them, one after the other, make each mosaic
  std::vector<FileStamp> files;        ///< others that they are made of, such as those that a VRT names, and of water
  ReadOptions reading;  ///< band, nodata, decode, z_scale, z_offset, z_unit, fill_distance, void_side and view
  Datum datum;
  FileStamp geoid;    ///< stamp of datum.geoid, if that is given
  WaterFiles waters;  ///< sources of plan.waters
  TileFormat format = TileFormat::kQuantizedMesh;
  std::optional<TileDrape> drape = std::nullopt;
  PyramidPlan plan;
  LayerFacts facts;   ///< but for the version
  std::string parts;  ///< folder of the parts of the plan before; empty for a plan that follows none
  /// Cost of each of find_blocks(), as survey_blocks() found; empty: not surveyed.
  std::vector<std::uint32_t> costs;
  std::optional<TileEstimate> estimate;  ///< no part of any key
  std::uint64_t filled = 0;              ///< missing samples that were filled; no part of any key
};

/// The bytes that the job keeps of a tile. Opens its image. Borrows the job. Fails as open_globe_image().
Result<TileEncoder> open_tile_encoder(const TileJob& job);

/// Sets job.rasters and job.files: the files of these rasters, by list_files().
void stamp_rasters(TileJob& job, const std::vector<std::string>& paths);

/// Reads job.waters, if there are any, finds their levels on the raster's nodes, and sets job.plan.waters, job.files
/// and the raster's nodes(). Fails as read_lines() and find_tile_waters() do. REQUIRES: job.plan is set, of this
/// raster.
Result<void> find_waters(TileJob& job, GlobeRaster& raster);

/// The text of a plan file: JSON. Numbers are read back exactly.
std::vector<std::uint8_t> encode_tile_job(const TileJob& job);
/// Fails with kInput for what is no plan of this version of Scarp's.
Result<TileJob> decode_tile_job(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);
/// decode_tile_job() of a file. Fails with kInput where it cannot be read, too.
Result<TileJob> read_tile_job(const std::string& path);
/// The rasters by mosaics, as GlobeRaster::open() accepts them.
std::vector<std::vector<std::string>> mosaics_of(const TileJob& job);
/// A hash of all of it.
std::uint64_t key_of(const TileJob& job);
/// A hash of all that makes tiles from nodes: parts of other settings are not reused.
std::uint64_t settings_key_of(const TileJob& job);
/// A hash of the files' stamps: of their content alone where that is known.
std::uint64_t sources_key_of(const TileJob& job);
/// Reads all files for their content. Fails with kInput.
Result<void> add_contents(TileJob& job);
/// The first file, the geoid's included, that is not what it was when the plan was made, and what became of it: "a.tif
/// is not there any more". Nothing if all are.
std::optional<std::string> find_changed(const TileJob& job);
/// Fails with kInput for find_changed().
Result<void> check_rasters(const TileJob& job);

/// A job for rasters that have changed, or for others, with the levels and settings of an earlier one, so that what did
/// not change keeps its bytes. `now`: of these rasters, with the earlier's finest level and max error. Fails with
/// kUsage where their heights need coarser steps than the earlier levels have.
Result<TileJob> follow_job(const TileJob& earlier, TileJob now);

/// Makes `samples` tiles of the finest level, evenly over the blocks, on one thread. Fails as make_tile() does.
Result<TileEstimate> estimate_tiles(const TileJob& job, const NodeSource& nodes, int samples = 24);

/// Reads all nodes once and sets job.costs: 1 for a block, and 1000 times the share of its nodes that have heights;
/// shares are then of equal cost. Memory: some rows of a block's nodes a thread. Progress: pass "survey". Fails as the
/// source does, and with kCancelled.
Result<void> survey_blocks(TileJob& job, const NodeSource& nodes, const Run& run = {});

/// One of n shares of the blocks: consecutive ones of find_blocks(), 1 … of, of about the same cost.
struct Shard {
  std::uint32_t number = 1, of = 1;
};

/// The blocks that processes made so far: files in a folder. Each process that makes some writes a file of its own,
/// which it only ever appends to; a record that was cut off is ignored. A record holds the files' stamps and the hash
/// of the nodes that a block was made of, or that a block of these nodes is right for other stamps, too.
class TileParts {
 public:
  /// Reads all parts in the folder, which need not be there. Fails with kInput for parts of other settings, and where
  /// they cannot be read.
  static Result<std::unique_ptr<TileParts>> open(const std::string& folder, const TileJob& job);
  TileParts(const TileParts&) = delete;
  TileParts& operator=(const TileParts&) = delete;
  ~TileParts();

  /// The block, of the job's sources.
  bool has(TileId block) const;
  /// The block, of any sources.
  bool has_any(TileId block) const;
  /// The block, of these nodes.
  bool has_nodes(TileId block, std::uint64_t nodes) const;
  /// Reads the parts of one share again. Fails as open().
  Result<void> look_again(Shard shard);
  /// Returns the report of make_block(), and hands each of the block's tiles, in their order, to `put`. Fails with
  /// kInput for a damaged part, with the file's name, and as `put` does.
  Result<BlockReport> read(TileId block,
                           const std::function<Result<void>(TileId, std::span<const std::uint8_t>)>& put) const;

 private:
  friend class PartWriter;
  struct Impl;
  explicit TileParts(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The work of one process.
struct PartsReport {
  std::uint64_t blocks = 0;     ///< made now
  std::uint64_t there = 0;      ///< number in its share that were made before, or meanwhile by another process
  std::uint64_t unchanged = 0;  ///< made before of other files, whose nodes are the same
  std::uint64_t tiles = 0, bytes = 0;
  bool has_company = false;  ///< another process made the same share when this one began
};

/// Makes the blocks of a share that no part has, and appends them to a new file of the folder, which is made if needed.
/// Each block is on the disk before the next is begun. `only`: omits blocks that do not touch it. If a block exists
/// from other sources, its nodes are read, and it is made again if they differ. Two processes may make one share at
/// once: the second begins at its end. Progress: pass "tiles"; `tell` receives the report after each block. Fails as
/// make_block(), as check_rasters() after each block, which is not kept then, with kOutput where the file cannot be
/// written, and with kCancelled; blocks that were made stay.
Result<PartsReport> make_parts(const TileJob& job, const NodeSource& nodes, const std::string& folder, Shard shard,
                               const Run& run = {}, const std::optional<DegreeBox>& only = {},
                               const std::function<void(const PartsReport&)>& tell = {});

/// The cost of making the blocks of a set.
struct PartsCost {
  double core_seconds = 0;   ///< total of all blocks, with the levels above
  std::uint64_t memory = 0;  ///< the most that a process had, its raster included
  std::uint64_t parts = 0;   ///< bytes of the parts' records
};

/// Puts all tiles of the parts and the levels above them into the set, and finishes it. Fails with
/// kInput where blocks are missing, with their number, and as finish_pyramid() and the set do.
Result<PyramidReport> finish_parts(const TileJob& job, const std::string& folder, TileSetWriter& set,
                                   const Run& run = {}, PartsCost* cost = nullptr);

}  // namespace scarp

#pragma GCC visibility pop
