// Make tile sets from raster files, in one or several processes, on one machine or on several that share a folder.
//
//   plan     encode_tile_job(): everything on which a tile depends, in a file
//   run      make_parts(): each process makes blocks of the plan and stores them in parts
//   finish   finish_parts(): makes the levels above the blocks, and the set
//
// Processes exchange only the plan and the parts. A block in a part is never remade, so an interrupted run resumes
// where it stopped. The set is that of make_pyramid(), byte for byte, regardless of which process made its blocks.
//
// After the sources have changed, a new plan with the settings of the earlier plan reuses the earlier parts: blocks
// with unchanged nodes are kept.
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

// The position of a raster on the globe, and the zero (vertical datum) of its heights.

/// The zero of heights.
enum class Vertical {
  kAuto,       ///< the vertical datum of the raster's CRS
  kEllipsoid,  ///< the ellipsoid, as for GPS heights
  kEgm96,      ///< the geoid EGM96, approximately the sea: egm96()
  kEpsg,       ///< a vertical CRS of EPSG, by PROJ and its grids
  kGeoid,      ///< a surface stored in a raster
  kNone,       ///< unknown: heights are used unchanged, as if above the ellipsoid
};

/// The user's choice of the zero of a raster's heights, and of its ellipsoid.
struct Datum {
  Vertical vertical = Vertical::kAuto;
  int epsg = 0;            ///< code for kEpsg: 3855 is EGM2008
  std::string geoid = {};  ///< file for kGeoid: a raster of the surface's heights above the ellipsoid, in metres (GTX,
                           ///< GeoTIFF, …)
  /// Replaces the ellipsoid of the CRS; the raster's longitudes and latitudes are then used unchanged.
  std::optional<Geodetic> ellipsoid = std::nullopt;
};

/// The position of a raster on the globe.
struct RasterOnGlobe {
  RasterPlace place;
  std::shared_ptr<const PointTransform> to_degrees;  ///< null if place.from_degrees is null
  std::string degrees;                               ///< the CRS of longitude and latitude, as RasterInfo::crs
  Geodetic ellipsoid;
  std::string body;                        ///< name of the celestial body, from the CRS; empty for WGS 84
  std::shared_ptr<const HeightZero> zero;  ///< zero of the heights; null if it is the ellipsoid
  double zero_reach = 0;                   ///< max distance of the zero from the ellipsoid, in metres
  std::string vertical;                    ///< the zero of the heights, in words
};

struct RasterOnPlane {
  double cell_x = 1, cell_y = 1;
  std::string units;                  ///< unit of cell_x and cell_y: "metre", "cell", or "unit of the raster's x and y"
  std::string vertical;               ///< the zero of the heights, in words
  std::optional<PlaneOnGlobe> globe;  ///< nothing for a raster without a position on the globe
  Geodetic ellipsoid;                 ///< the ellipsoid that the plane touches; only with `globe`
  std::string body;                   ///< see RasterOnGlobe::body
  std::vector<std::string> warnings;  ///< warns if the plane lies far from the globe
  /// The position of each sample on the globe, if any.
  std::optional<RasterOnGlobe> samples = std::nullopt;
};

// Encoders and sinks: they turn the tiles of a pyramid into files of a set.

/// The encoder of a format. It compresses quantized-mesh with gzip: servers must send "Content-Encoding: gzip" with
/// such tiles. Borrows the plan.
TileEncoder make_tile_encoder(TileFormat format, const PyramidPlan& plan);

/// Writes tiles of a format to a set.
class TileSetSink : public TileSink {
 public:
  /// Borrows `writer` and `plan`. DEFAULT encoder: that of the format.
  TileSetSink(TileSetWriter& writer, TileFormat format, const PyramidPlan& plan, TileEncoder encoder = {});

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override;
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override;
  /// A hash of all tiles so far, independent of their order: 16 hexadecimal digits.
  std::string version() const;
  /// Writes the metadata file for clients, layer.json. Called once, after all tiles. Adds the format's additional error
  /// to the bounds in the report. Fails with kOutput.
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

/// The sink of a format. Borrows `writer` and `plan`. DEFAULT encoder: that of the format.
std::unique_ptr<TileSetSink> make_tile_sink(TileFormat format, TileSetWriter& writer, const PyramidPlan& plan,
                                            TileEncoder encoder = {});

struct TileJob;

/// Rasters in order of priority, opened as one source of nodes on the globe: a node has the height of the first raster
/// with a height there. Each raster has its own CRS, cells, nodata value and datum. Alternatively, one raster on a
/// plane.
class GlobeRaster {
 public:
  /// `mosaics`: at least one; the rasters of each mosaic lie on one grid, see find_mosaics(). Reads them, or streams
  /// them from their files if memory is too small, as open_height_field() does; options.crs and options.view.more are
  /// ignored. Fails as open_height_field() and place_on_globe() do. Also fails with kUsage for options.view with
  /// several mosaics, and for a datum that contradicts a raster's CRS, and with kInput for rasters of several planets.
  ///
  /// `grid`: std::nullopt selects the grid that suits the first raster: grid_for(). A local grid needs exactly one
  /// mosaic (else kUsage), which place_on_plane() positions.
  static Result<std::unique_ptr<GlobeRaster>> open(const std::vector<std::vector<std::string>>& mosaics,
                                                   const ReadOptions& options, const Datum& datum,
                                                   std::optional<GridKind> grid = GridKind::kGeographic);
  GlobeRaster(const GlobeRaster&) = delete;
  GlobeRaster& operator=(const GlobeRaster&) = delete;
  ~GlobeRaster();

  /// Heights above the ellipsoid. Valid until water is added or this object is destroyed.
  const NodeSource& nodes() const;
  /// Adds the plan's water, if any, to nodes(). REQUIRES: called once, with a plan for this raster.
  void add_waters(const PyramidPlan& plan);
  /// The facts for plan_pyramid(). REQUIRES: opened with options.with_range.
  std::vector<SourceFacts> facts() const;
  /// The grid of tiles, with `cells` cells a side for tiles of the finest level.
  TileGrid grid(int cells) const;
  const std::optional<RasterOnPlane>& plane() const;  ///< nothing without a local grid
  const RasterInfo& info() const;                     ///< metadata of the first raster
  const RasterOnGlobe& place() const;                 ///< position of the first raster
  VoidCount voids() const;                            ///< RasterInfo::voids of all rasters together
  std::string heights_above() const;                  ///< distinct RasterOnGlobe::vertical of all rasters
  std::vector<std::string> warnings() const;          ///< RasterInfo::warnings of all rasters, and those of
                                                      ///< find_waters()

 private:
  friend Result<void> find_waters(TileJob& job, GlobeRaster& raster);
  struct Impl;
  explicit GlobeRaster(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The data by which a changed file is detected.
struct FileStamp {
  std::string path;  ///< absolute, if it names a file
  std::uint64_t size = 0;
  std::int64_t changed = 0;   ///< nanoseconds since 1970; like the size, 0 for a path that is not a file, such as a URL
  std::uint64_t content = 0;  ///< a hash of its bytes; 0: not read

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
/// Returns the stamp of an existing file; for other paths, only the path is set.
FileStamp stamp_of(const std::string& path);

/// The estimated cost of making a set, from a sample of tiles.
struct TileEstimate {
  std::uint64_t blocks = 0;        ///< blocks that may have heights
  std::uint64_t finest_tiles = 0;  ///< tiles on the finest level
  std::uint64_t tiles = 0;         ///< tiles on all levels
  std::uint64_t bytes = 0;         ///< size of the tiles, as stored
  double core_seconds = 0;         ///< on this machine
  std::uint64_t memory = 0;        ///< bytes for a process with one thread, without the raster
  std::uint64_t parts = 0;         ///< bytes of the parts, needed until the set is finished
};

/// Vector files of water, as read_lines() accepts them: FILE or FILE:LAYER.
struct WaterFiles {
  std::vector<std::string> lakes, rivers;
  double percentile = 5;  ///< like WaterOptions::percentile

  bool is_empty() const { return lakes.empty() && rivers.empty(); }
};

/// An image draped over the tiles, for 3D Tiles only.
struct TileDrape {
  std::vector<FileStamp> files;  ///< the image and the other files that it uses
  ImageFormat format = ImageFormat::kJpeg;

  const std::string& path() const { return files.front().path; }
};
/// The stamps of an image.
TileDrape stamp_drape(const std::string& path, ImageFormat format);

/// Everything on which a set depends.
struct TileJob {
  std::vector<FileStamp> rasters;      ///< in order of priority
  std::vector<std::uint32_t> mosaics;  ///< number of consecutive rasters in each mosaic
  std::vector<FileStamp> files;        ///< other files that the rasters use, such as the sources of a VRT, and the
                                       ///< files of water
  ReadOptions reading;  ///< only band, nodata, decode, z_scale, z_offset, z_unit, fill_distance, void_side and view
  Datum datum;
  FileStamp geoid;    ///< stamp of datum.geoid, if given
  WaterFiles waters;  ///< sources of plan.waters
  TileFormat format = TileFormat::kQuantizedMesh;
  std::optional<TileDrape> drape = std::nullopt;
  PyramidPlan plan;
  LayerFacts facts;   ///< except the version
  std::string parts;  ///< folder of the parts of the earlier plan; empty if there is none
  /// Cost of each block of find_blocks(), from survey_blocks(); empty: not surveyed.
  std::vector<std::uint32_t> costs;
  std::optional<TileEstimate> estimate;  ///< not part of any key
  std::uint64_t filled = 0;              ///< missing samples that were filled; not part of any key
};

/// The encoder of the job's tiles. Opens the image, if any. Borrows the job. Fails as open_globe_image() does.
Result<TileEncoder> open_tile_encoder(const TileJob& job);

/// Sets job.rasters and job.files: the files of these rasters, by list_files().
void stamp_rasters(TileJob& job, const std::vector<std::string>& paths);

/// Reads job.waters, if any, finds the lakes' levels from the raster's nodes, and sets job.plan.waters, job.files and
/// the raster's nodes(). Fails as read_lines() and find_tile_waters() do. REQUIRES: job.plan is a plan for this raster.
Result<void> find_waters(TileJob& job, GlobeRaster& raster);

/// The text of a plan file: JSON. Numbers are read back exactly.
std::vector<std::uint8_t> encode_tile_job(const TileJob& job);
/// Reads the text of a plan file. Fails with kInput unless it is a plan of this version of Scarp.
Result<TileJob> decode_tile_job(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);
/// Reads a plan file with decode_tile_job(). Also fails with kInput if the file cannot be read.
Result<TileJob> read_tile_job(const std::string& path);
/// The rasters grouped into mosaics, for GlobeRaster::open().
std::vector<std::vector<std::string>> mosaics_of(const TileJob& job);
/// A hash of the whole job.
std::uint64_t key_of(const TileJob& job);
/// A hash of all settings for making tiles from nodes. Parts with another hash are not reused.
std::uint64_t settings_key_of(const TileJob& job);
/// A hash of the files' stamps or, if known, only of their content.
std::uint64_t sources_key_of(const TileJob& job);
/// Sets FileStamp::content of all files. Fails with kInput.
Result<void> add_contents(TileJob& job);
/// Describes the first file (including the geoid) that has changed since the plan was made: "a.tif is not there any
/// more". Nothing if no file has changed.
std::optional<std::string> find_changed(const TileJob& job);
/// Fails with kInput if find_changed() returns a file.
Result<void> check_rasters(const TileJob& job);

/// Makes a job for changed or other rasters with the levels and settings of an earlier job, so that unchanged tiles
/// keep their bytes. `now`: a job for these rasters, with the earlier job's finest level and max error. Fails with
/// kUsage if the rasters' heights need coarser steps than the earlier levels have.
Result<TileJob> follow_job(const TileJob& earlier, TileJob now);

/// Makes `samples` tiles of the finest level, spread evenly over the blocks, on one thread. Fails as make_tile() does.
Result<TileEstimate> estimate_tiles(const TileJob& job, const NodeSource& nodes, int samples = 24);

/// Reads all nodes once and sets job.costs: 1 for a block, plus 1000 times the share of its nodes that have heights.
/// Shards then have equal cost. Memory: some rows of a block's nodes for each thread. Progress: pass "survey". Fails as
/// the source does, and with kCancelled.
Result<void> survey_blocks(TileJob& job, const NodeSource& nodes, const Run& run = {});

/// Shard `number` (1 … `of`) of the blocks: consecutive blocks of find_blocks(). All shards cost about the same.
struct Shard {
  std::uint32_t number = 1, of = 1;
};

/// The blocks made so far: files in a folder. Each process appends to its own file; a truncated record is ignored. A
/// record contains a block with the files' stamps and the hash of its nodes, or states that a block with these nodes is
/// also valid for other stamps.
class TileParts {
 public:
  /// Reads all parts in the folder, which need not exist. Fails with kInput for parts of other settings and for
  /// unreadable parts.
  static Result<std::unique_ptr<TileParts>> open(const std::string& folder, const TileJob& job);
  TileParts(const TileParts&) = delete;
  TileParts& operator=(const TileParts&) = delete;
  ~TileParts();

  /// True if the block exists for the job's sources.
  bool has(TileId block) const;
  /// True if the block exists for any sources.
  bool has_any(TileId block) const;
  /// True if the block exists for these nodes.
  bool has_nodes(TileId block, std::uint64_t nodes) const;
  /// Rereads the parts of one shard. Fails as open() does.
  Result<void> look_again(Shard shard);
  /// Returns the report of make_block(), and passes the block's tiles in order to `put`. Fails with kInput for a
  /// damaged part, naming the file, and as `put` does.
  Result<BlockReport> read(TileId block,
                           const std::function<Result<void>(TileId, std::span<const std::uint8_t>)>& put) const;

 private:
  friend class PartWriter;
  struct Impl;
  explicit TileParts(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

struct PartsReport {
  std::uint64_t blocks = 0;     ///< made now
  std::uint64_t there = 0;      ///< blocks of the shard that were made earlier, or meanwhile by another process
  std::uint64_t unchanged = 0;  ///< blocks made earlier from other files with the same nodes
  std::uint64_t tiles = 0, bytes = 0;
  bool has_company = false;  ///< true if another process was making the same shard when this process began
};

/// Makes the missing blocks of a shard, and appends them to a new file of the folder, which is created if needed. Each
/// block is written to disk before the next one is made. `only`: omits blocks that do not touch this box. If a block
/// exists that was made from other sources, its nodes are read, and the block is remade if they differ. Two processes
/// may make one shard at once; the second one starts from the shard's end. Progress: pass "tiles"; `tell` receives the
/// report after each block. Fails as make_block() does, and as check_rasters() does after each block (which is then
/// discarded). Also fails with kOutput if the file cannot be written, and with kCancelled. Finished blocks remain.
Result<PartsReport> make_parts(const TileJob& job, const NodeSource& nodes, const std::string& folder, Shard shard,
                               const Run& run = {}, const std::optional<DegreeBox>& only = {},
                               const std::function<void(const PartsReport&)>& tell = {});

struct PartsCost {
  double core_seconds = 0;   ///< total of all blocks and of the levels above
  std::uint64_t memory = 0;  ///< peak memory of a process, including its raster
  std::uint64_t parts = 0;   ///< bytes of the parts' records
};

/// Writes all tiles of the parts and of the levels above them to the set, and finishes it. Fails with kInput if blocks
/// are missing, and reports their number; also fails as finish_pyramid() and the set do.
Result<PyramidReport> finish_parts(const TileJob& job, const std::string& folder, TileSetWriter& set,
                                   const Run& run = {}, PartsCost* cost = nullptr);

}  // namespace scarp

#pragma GCC visibility pop
