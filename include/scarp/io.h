// Read rasters and meshes, and write meshes, rasters and images.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif", {.crs = "EPSG:32616"}));
//     std::printf("%d x %d samples, %g to %g\n", dem.cols, dem.rows, dem.info.min, dem.info.max);
//     SCARP_TRY(const auto& mesh, scarp::read_mesh("hills.glb"));
//     SCARP_RETURN_IF_ERROR(scarp::write_mesh(mesh, "hills.ply"));
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/point_blocks.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

// Mesh formats: one table for options, help, completions, messages, writers and readers.

/// The frame of a mesh if no CRS is chosen.
enum class DefaultFrame {
  kLocal,   ///< relative to the raster's centre; for viewers, which need short numbers
  kMetric,  ///< local for a raster in degrees, else the raster's own CRS; for 3-D shapes in double
  kSource,  ///< the raster's own CRS, even in degrees; for maps
};

/// The unit of a field's heights. Heights without a declared unit are assumed to be in the unit of the CRS's x and y if
/// that is a length, else in metres.
enum class HeightsIn {
  kFrame,   ///< metres in space and in local frames of a CRS, else the unit of the file
  kMetres,  ///< metres in every frame; for formats specified in metres
  kFile,    ///< the unit of the file
};

enum class MeshFormat { kGlb, kObj, kPly, kStl, kTin, k2dm, kVtu, kVtp, kLandXml, kDxf, kGpkg, k3mf, kMsh };

/// The properties of a format, independent of a mesh. Table entries omit default values.
struct MeshFormatTraits {
  MeshFormat format;
  const char* name;             ///< "landxml", for --of; one of the endings
  const char* title;            ///< "LandXML": for sentences
  const char* endings;          ///< "xml landxml": endings of file names, the usual one first
  const char* shared = "";      ///< an ending shared with files of other kinds: "xml"
  const char* media_type = "";  ///< empty: none registered
  const char* contents;         ///< contents of a file, in a few words
  const char* read_by;          ///< programs that read the format

  // The position of a mesh.
  DefaultFrame frame = DefaultFrame::kMetric;  ///< frame of x and y unless a CRS is requested
  HeightsIn heights = HeightsIn::kFrame;
  char up = 'z';                     ///< the axis that points up, 'y' or 'z'
  bool has_choice_of_up = false;     ///< --up selects the axis; `up` is the axis that most readers expect
  bool is_float32 = false;           ///< positions are offsets from the origin, rounded to float32; else doubles
  bool has_lengths_only = false;     ///< degrees are rejected
  bool has_projection_file = false;  ///< a .prj file holds the CRS, since not all readers use a CRS in the mesh file

  // Contents of a file in addition to triangles.
  bool holds_attributes = false;  ///< normals, uvs, colours
  bool holds_zones = false;       ///< materials and node strings: MeshZones
  bool holds_prints = false;      ///< 3-D printing programs read its numbers as millimetres
  bool holds_solids_only = false;
  bool holds_space = true;  ///< z may differ from the height

  bool is_read = true;                   ///< decode_mesh() reads it; else write-only
  bool counts_in_int32 = false;          ///< its readers count vertices and triangles in signed 32-bit numbers
  std::uint64_t bytes_per_vertex = 260;  ///< approximate memory to write a vertex and its two triangles, including the
                                         ///< bytes of the file
};

/// All formats, in the order of MeshFormat.
std::span<const MeshFormatTraits* const> mesh_formats();
/// REQUIRES: `format` is a value of MeshFormat.
const MeshFormatTraits& traits_of(MeshFormat format);

/// Finds the format by its name ("glb", "OBJ", "landxml", …) or by a path's extension (".xml" is LandXML). Returns
/// nothing for an unknown format.
std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path);
/// Finds the format of a mesh file for decode_mesh(), by the ending of its name and, if files of other kinds share that
/// ending, by its first bytes. Returns nothing for other files.
std::optional<MeshFormat> find_mesh_file(const std::string& path);

struct MeshZones;

enum class Decode { kNone, kTerrarium, kMapbox };

/// Several rasters read as one, or a part or a coarser version of a raster.
struct RasterView {
  /// Rasters that form a mosaic with the first raster. Where several rasters have a value, that of the last one is
  /// used; where none has a value, the sample is missing. All rasters have the same CRS, vertical datum, number of
  /// bands, unit and grid. Sample type, nodata value, mask, scale and offset may differ. Rasters on both sides of the
  /// 180th meridian are placed side by side.
  std::vector<std::string> more = {};
  /// xmin, ymin, xmax, ymax in the units of the raster's CRS: only cells that overlap this rectangle are read.
  std::optional<std::array<double, 4>> extent = std::nullopt;
  /// Approximate cell size, in the units of the CRS. Blocks of k × k cells become one cell, with the mean of their
  /// valid samples. The new cell is not larger than this size. Surplus columns and rows at the right and the bottom are
  /// omitted.
  std::optional<double> resolution = std::nullopt;

  bool is_whole() const { return more.empty() && !extent && !resolution; }
};

struct ReadOptions {
  int band = 1;                                 ///< 1-based
  std::optional<double> nodata = std::nullopt;  ///< replaces the file's nodata value, which then is an ordinary height
  Decode decode = Decode::kNone;  ///< encoding of heights in red, green, blue (8 bit each); alpha 0 is nodata
  /// Frame of the mesh. Empty (DEFAULT): `default_frame` or, without georeference, the grid frame. "source": the
  /// raster's own coordinates. "local": metres around the raster's centre. "grid": columns and rows. "enu", or a
  /// geocentric CRS ("EPSG:4978"): a frame in space, where the earth is round (Frame::space). Anything else is a CRS
  /// for GDAL ("EPSG:32611", "32611", WKT, PROJ string).
  std::string crs = {};
  DefaultFrame default_frame = DefaultFrame::kLocal;
  /// A height is z_scale · value + z_offset, where `value` is the file's value with the file's scale and offset
  /// applied. The field's heights, range and errors refer to this height; `nodata` refers to the file's value. DEFAULT:
  /// as in the file.
  double z_scale = 1, z_offset = 0;  ///< finite; z_scale is not 0
  /// The unit of these heights before the conversion to metres: "m", "ft", "us-ft" … or the file's own word. DEFAULT:
  /// the unit of the file or of its vertical CRS; metres if `z_scale` converts this unit to metres; unknown for any
  /// other factor.
  std::string z_unit = {};
  /// The unit of the field's heights. If heights are converted to metres, RasterInfo::z_scale is the product of both
  /// factors. Fails with kUsage if heights in an unknown unit must be converted.
  HeightsIn heights_in = HeightsIn::kFrame;
  /// Width of a cell in the mesh, for a raster without georeference or with crs "grid"; the frame is then centred on
  /// the raster. Fails with kUsage for any other frame. DEFAULT: 1, the grid frame.
  std::optional<double> cell_size = std::nullopt;
  /// Memory::limit (0: the machine's memory), and progress. read_height_field() fails for a raster that needs more
  /// memory; open_height_field() always stays within the limit.
  Run run = {};
  /// open_height_field() reads a streamed raster once, to set the range in RasterInfo. DEFAULT: false.
  bool with_range = false;
  /// The samples are tolerances or weights, not heights: a raster without any value is not an error, and the warning
  /// about infinities names the file. DEFAULT: false.
  bool as_values = false;
  /// Nodata samples within this many samples of a height are filled by fill_nodata(), and then count as heights. The
  /// range in RasterInfo is the range before filling. Fails with kInput if the samples, as floats, exceed the memory
  /// limit. DEFAULT: 0, no filling.
  double fill_distance = 0;
  /// Enclosed voids (8-connected nodata away from the raster's edge) of at most this many samples per side are filled
  /// with the heights of fill_nodata(), in memory or while windows are read. RasterInfo::voids has the counts. DEFAULT:
  /// 0, no filling.
  int void_side = 0;
  /// The view of the rasters, always read by GDAL. Fails with kInput for rasters that form no mosaic or do not overlap
  /// the extent. Fails with kUsage for an extent or a resolution unless x runs east, and y north or south. DEFAULT: one
  /// unchanged raster.
  RasterView view = {};
};

/// Reads one raster. Scarp's own readers read PGM (P2, P5) and Scape's STM. GDAL reads all other formats from any path
/// or URL that it opens (also /vsicurl/, /vsizip/, http:// and https://), except HDF4, whose library crashes on damaged
/// files. Standard input ("-") and pipes are copied to an unnamed file in the folder for temporary files. Nodata
/// (declared, overridden, mask band, alpha, NaN, ±infinity) becomes NaN. Fails with kInput for a file that is missing,
/// truncated or not a raster, for fewer than 2×2 samples, for a band out of range, and for a raster without valid
/// samples. Fails with kUsage for a CRS that is unknown or has no transformation.
Result<OwnedHeightField> read_height_field(const std::string& path, const ReadOptions& options = {});

/// Reads the samples next to a part of a raster, for Border::beyond. The part was read by read_height_field() with an
/// extent (ReadOptions::view). The result holds samples of the surrounding raster or mosaic. At sides where the raster
/// ends, and without an extent at all sides, the samples are unknown. Nodata is not filled. Fails as
/// read_height_field() does.
Result<BeyondEdges> read_beyond(const std::string& path, const ReadOptions& options, const RasterInfo& info, int cols,
                                int rows);

/// The position of a mesh in the coordinates of its raster's file.
struct PlaceInSource {
  /// From x and y of the mesh: source x = t[0] + t[1]·x + t[2]·y, source y = t[3] + t[4]·x + t[5]·y.
  std::array<double, 6> to_source{0, 1, 0, 0, 0, 1};
  std::string crs;  ///< CRS of the source, as RasterInfo::crs; empty if none

  /// Source coordinates of x = 0, y = 0.
  std::array<double, 2> origin() const { return {to_source[0], to_source[3]}; }
};
/// Returns nothing for non-affine frames. Without georeference, source coordinates are those of the grid frame.
std::optional<PlaceInSource> place_in_source(const Frame& frame, const RasterInfo& info, int rows);

/// True if ReadOptions::crs requests a frame in space: "enu" or a geocentric CRS. False in a build without GDAL.
bool is_in_space(const std::string& crs);

/// Returns the CRS as the text of a .prj file (ESRI's WKT, one line); nothing for an unknown CRS, and in a build
/// without GDAL.
std::optional<std::string> projection_text(const std::string& crs);

/// Opens one raster of any size, for simplify() and measure(). If its samples as floats (4 bytes each) fit the memory
/// limit, they are read as by read_height_field(). If only its 16-bit samples (2 bytes each: Byte, Int16 and UInt16
/// without a mask other than nodata) fit, they are read unchanged, and the field has a source. Otherwise the raster is
/// streamed: the source reads one window at a time from the file through GDAL's block cache, whose size is the memory
/// limit plus 8 MB (unless GDAL_CACHEMAX is set). If two rows of blocks fit the cache, a pass decodes the file once or
/// twice. Otherwise, it decodes blocks again for every few rows.
///
/// A streamed raster has no range in its info unless options.with_range is set. Its infinities become nodata without a
/// warning, and a file without any height is not an error. Samples that may not fit float32 (32-bit and larger
/// integers, float64, scaled values) are always read once to find sample_rounding. The samples equal those of
/// read_height_field(). Fails as read_height_field() does, and for a PGM or STM larger than the memory limit.
Result<OwnedHeightField> open_height_field(const std::string& path, const ReadOptions& options = {});

struct OwnedChannels {
  int cols = 0, rows = 0;
  std::vector<std::vector<float>> bands;  ///< each row-major, cols·rows; nodata is NaN
  bool is_8bit = false;                   ///< the file contains bytes
  bool is_color = false;                  ///< three bands: red, green, blue
  Frame frame;
  RasterInfo info;
};

/// Reads all bands of an image (or only `band` of the options, if `all_bands` is false) by GDAL; PGM and STM also
/// without GDAL. Palettes become red, green and blue bands. `info` counts samples with a value in every band as valid;
/// its range covers all bands. Fails as read_height_field() does (options.crs "grid" never fails), and with kInput for
/// more than kMaxChannels bands, for an alpha band among them, and for packed heights (options.decode).
Result<OwnedChannels> read_channels(const std::string& path, const ReadOptions& options = {}, bool all_bands = true);

/// Longitude and latitude in degrees of a position in a CRS (as in RasterInfo and PointSet): in WGS 84 if PROJ has a
/// transformation to it, else on the CRS's own ellipsoid. Returns nothing if the CRS is empty or unknown, if PROJ has
/// no transformation, and in a build without GDAL.
std::optional<std::array<double, 2>> find_degrees(const std::string& crs, double x, double y);

/// Returns nothing if two rasters lie on the same grid; else the difference, as the end of a sentence ("is 10 x 20
/// samples instead of 30 x 40", "is in EPSG:32611 instead of EPSG:4326", "begins at …"). A raster without georeference
/// fits any raster of its size.
std::optional<std::string> find_grid_difference(const RasterInfo& raster, int cols, int rows, const RasterInfo& other,
                                                int other_cols, int other_rows);

/// The result of read_script(): samples to insert and to ignore, in the order of the script's lines.
struct Script {
  std::vector<SampleAt> inserted;  ///< for Features::points
  std::vector<SampleAt> ignored;   ///< for Tolerances::ignored

  std::size_t size() const { return inserted.size() + ignored.size(); }
};

/// Reads a script (Terra's -s), one step a line: "s x y" inserts, "i x y" ignores, "u x y" marks the height as unknown
/// (as i); x and y are column and row from the top left. Empty lines and # comments are skipped. Fails with kInput for
/// an unknown word, a missing number, a position outside cols × rows, and a sample that one line inserts and another
/// ignores. The message names the lines.
Result<Script> read_script(const std::string& path, int cols, int rows);

/// A raster to write: row-major, NaN is nodata.
struct RasterImage {
  std::span<const float> samples;
  int cols = 0, rows = 0;
  const RasterInfo* like = nullptr;  ///< georeference, CRS and unit are copied from it; may be null
};
enum class RasterFormat { kGeoTiff, kPgm };
/// Returns the file's bytes. GeoTIFF: float32, DEFLATE, NaN as nodata. PGM: P5 of 16 bits; samples are rounded to whole
/// numbers, and NaN becomes 65535. Fails with kOutput for PGM samples outside 0 … 65535.
Result<std::vector<std::uint8_t>> encode_raster(const RasterImage& raster, RasterFormat format);

/// A GeoTIFF, with the bytes of encode_raster(), for a raster larger than memory. Rows are added sequentially to a file
/// with a temporary name. write_files() renames this file; otherwise, it is removed.
class RasterFile {
 public:
  /// Fails as write_file() and encode_raster() do.
  static Result<RasterFile> create(const std::string& path, int cols, int rows, const RasterInfo* like,
                                   bool overwrite = true);
  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;
  ~RasterFile();

  /// Adds the next row, from the top. Fails with kOutput.
  Result<void> add(std::span<const float> row);
  /// Completes the file. Fails with kOutput. REQUIRES: all rows were added.
  Result<void> finish();
  std::uint64_t size() const;            ///< size of the file; after finish()
  static std::uint64_t bytes(int cols);  ///< bytes of memory for a RasterFile

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  explicit RasterFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Largest number of samples that fit `memory_limit` bytes at 5 bytes per sample. 0 means the machine's memory.
std::uint64_t max_samples(std::uint64_t memory_limit);

/// A chain of edges, such as an inflow boundary, a cross-section, the crest of a dam.
struct NodeString {
  std::string name;                  ///< name of the line
  std::vector<std::uint32_t> nodes;  ///< vertices joined by edges; a closed string ends with its first vertex
};

/// Materials and node strings; encode_mesh() writes them if the format can hold them (MeshFormatTraits::holds_zones). A
/// 2DM file stores materials in E3T cards, and node strings in NS cards of at most ten nodes. A string's last node is
/// negative; the string's number follows, counted from 1.
struct MeshZones {
  std::vector<std::uint32_t> materials;  ///< one for each triangle. EMPTY: all are 1
  std::vector<NodeString> node_strings;  ///< EMPTY: none
};

struct EncodeOptions {
  bool double_positions = false;     ///< PLY: doubles even where float32 is exact
  const MeshZones* zones = nullptr;  ///< materials and node strings, for MeshFormatTraits::holds_zones; null: none
};

/// Returns the file's bytes:
/// - GLB: y up (x, z, −y), float32, the origin as node translation, metadata in asset.extras;
/// - OBJ: text, absolute coordinates that read back to the same doubles, metadata as comments;
/// - PLY: binary little-endian, absolute;
/// - STL: binary, float32 offsets from the origin, z up;
/// - TIN, 2DM, LandXML, DXF: text, absolute coordinates that read back to the same doubles;
/// - VTU, VTP: double, absolute, raw little-endian arrays after the XML;
/// - GeoPackage: double, absolute, in the CRS of metadata["crs"];
/// - 3MF: as encode_3mf() with one object.
///
/// Some formats have fields for colours, uvs and channels: GLB (COLOR_0 as linear float, TEXCOORD_0, _CHANNEL_n for
/// channels that colours cannot hold), PLY (red green blue uchar, s t float, channel_n float), OBJ (vt, colours after
/// the coordinates), VTU and VTP (Colors, TCoords, channel_n). These values read back the same, except PLY's t = 1 − v,
/// which is rounded to float32. The bytes are deterministic for fixed versions of GDAL and SQLite (GeoPackage) and of
/// zlib (3MF). Fails with kOutput if the format cannot hold the mesh. 2DM and LandXML hold at most 2³¹ − 1 vertices and
/// triangles. LandXML holds no degrees or unknown units, and no heights in another unit than x and y.
///
/// PLY has float32 positions if float32 holds each of them exactly, as in the local frame; otherwise, and with
/// `double_positions`, it has doubles. Meshes of turn_y_up() can be written as OBJ, PLY or STL; decode_mesh() turns
/// them z-up again.
Result<std::vector<std::uint8_t>> encode_mesh(const Mesh& mesh, MeshFormat format, const EncodeOptions& options = {});
/// A 3MF file (core specification 1.2) of one or more solids, each an object named by its metadata["name"]. Positions
/// are offsets from the origin of the first object, rounded to float32, and read back the same. The file's other
/// metadata is that of the first object. The unit is the millimetre if metadata["placement"] shows that the solid was
/// placed (place_mesh()), else the metre. Fails with kOutput for a mesh that is not a closed 2-manifold after rounding
/// (measure_solid()).
Result<std::vector<std::uint8_t>> encode_3mf(std::span<const Mesh> objects);
/// Joins GLB files into one file by MSFT_lod. The given files are levels of detail of one object, the finest first. The
/// nodes are NAME_LOD0, NAME_LOD1 …; the scene holds the first node, which refers to the others. Level k (from 0) is
/// shown while it covers at least ratio^(−2 (k + 1)) of the screen; the last level is shown at any smaller size.
/// REQUIRES: encode_mesh() made the files; `ratio` is above 1. Fails with kOutput above 4 GiB.
Result<std::vector<std::uint8_t>> join_glb_levels(std::span<const std::vector<std::uint8_t>> levels, double ratio);
/// Joins GLB files side by side into one file: the scene holds all nodes, and the metadata is that of the first file.
/// REQUIRES: encode_mesh() or encode_glb() made the files. Fails with kOutput above 4 GiB.
Result<std::vector<std::uint8_t>> join_glbs(std::span<const std::vector<std::uint8_t>> files);
/// The convention of a mesh file's coordinates, which the mesh itself (z up, absolute) no longer shows.
struct MeshFileAxes {
  char up = 0;               ///< 'y' or 'z'; 0 if neither the format nor the file declares it, and z is assumed
  bool has_offsets = false;  ///< positions in the file are offsets from Mesh::origin (GLB, STL, 3MF)
};
/// Reads all mesh formats except GeoPackage; recognises the format by content. `axes`, if given, receives the axes of
/// the file. Fails with kInput. Never trusts a length or an index in the file.
Result<Mesh> decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors,
                         MeshFileAxes* axes = nullptr);

/// Writes the bytes of encode_mesh() by write_file(). Fails with kOutput.
Result<void> write_mesh(const Mesh& mesh, const std::string& path, std::optional<MeshFormat> format = {},
                        bool overwrite = true);
/// Reads a file by decode_mesh().
Result<Mesh> read_mesh(const std::string& path, MeshFileAxes* axes = nullptr);

/// Writes bytes to a temporary file next to `path` (".scarp-R.tmp", R: 16 random hexadecimal digits) and renames it.
/// Fails with kOutput, also if `path` exists and `overwrite` is false. After a failure, no new file remains. Symbolic
/// links are followed, even to a missing file; an existing file keeps its permissions. Standard output ("-",
/// /dev/stdout), and existing devices and pipes, are written directly; a pipe without a reader fails with kOutput after
/// two seconds. A program should ignore SIGXFSZ to receive "file too large" as an error instead of being killed.
Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes, bool overwrite = true);
struct FileBytes {
  std::string path;
  std::span<const std::uint8_t> bytes;
  RasterFile* raster = nullptr;  ///< a finished file, created for `path`, instead of `bytes`
};
/// write_file() for several files that belong together. All are written to temporary files before the first is renamed.
/// So no file remains if the disk is full, the folder is read-only or a name exists. Devices and pipes are written
/// last.
Result<void> write_files(std::span<const FileBytes> files, bool overwrite = true);
/// Reads the whole file (or pipe). Fails with kInput if it cannot be read.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);
/// All files needed to read a raster or vector data: the file itself (without its layer, for "FILE:LAYER"), files next
/// to it (.aux.xml, .prj, …), the sources of a VRT, and an archive that contains the file (/vsizip/z.zip/a.tif,
/// /vsitar/…). Returns only the file itself if GDAL cannot open it; nothing for remote and missing files, and in a
/// build without GDAL.
std::vector<std::string> list_files(const std::string& path);
/// Groups the rasters into mosaics; folders are replaced by their rasters. A mosaic consists of successive rasters in
/// the list with the same grid, type, nodata value and CRS, including the vertical datum. A raster that cannot be
/// opened forms its own group.
std::vector<std::vector<std::string>> find_mosaics(const std::vector<std::string>& paths);

/// Returns of a laser pulse. A point without return numbers counts as the only return.
enum class PointReturns { kAll, kFirst, kLast, kOnly };

/// The points of a LAS file that are read. DEFAULT: all points except those marked as withheld.
struct PointChoice {
  std::vector<std::uint8_t> classes = {};  ///< ASPRS numbers: 2 for ground. EMPTY: all
  PointReturns returns = PointReturns::kAll;
  bool overlap = true;    ///< true: read overlap points of flight lines (marked, or class 12 in formats 0 to 5)
  bool withheld = false;  ///< true: read points marked as deleted

  bool operator==(const PointChoice&) const = default;
};

struct ReadPointsOptions {
  /// Layers of a vector file or a drawing (DXF), or surfaces of LandXML, separated by commas; "CgPoints" means
  /// LandXML's survey points. DEFAULT: the first layer with points, else the first with lines; for a drawing or
  /// LandXML, the only layer.
  std::string layer = {};
  /// Column or attribute with the height. DEFAULT: the third coordinate. If it is missing or 0 everywhere, the default
  /// is an attribute named z, height, elevation, elev, h, alt, ele, hoehe …, if any.
  std::string z_field = {};
  std::string crs =
      {};  ///< "source", "local" or a CRS, as ReadOptions::crs; DEFAULT: local metres for degrees, else source
  ProgressCallback progress = {};
  /// The contents of a text file's columns: "number,northing,easting,height,code", or as letters "pnezd"; "-" is an
  /// unused column. DEFAULT: the names in the header, else guessed from the columns.
  std::string columns = {};
  /// Points with this height are omitted and counted, as are points with an empty or non-finite height. NaN: only
  /// points with an empty or non-finite height are omitted. DEFAULT: the call fails if a height is missing.
  std::optional<double> nodata = {};
  /// Heights and their unit, as in ReadOptions. DEFAULT of z_unit: the unit in the name of the column or attribute
  /// ("elev_ft", "Elevation (mm)"), else that of the vertical CRS, else that of x and y.
  double z_scale = 1, z_offset = 0;
  std::string z_unit = {};
  HeightsIn heights_in = HeightsIn::kFrame;
  /// With kLocal and without `crs`, x and y in units other than metres become local metres. x and y in metres do not
  /// change; the caller moves them to local_origin(). `heights_in` treats x and y as local in both cases.
  DefaultFrame default_frame = DefaultFrame::kMetric;
  /// xmin, ymin, xmax, ymax in the file's own coordinates: only points in this rectangle, including its sides, are
  /// read. Only the necessary parts of a COPC file are read. Fails with kUsage for lines. DEFAULT: all points.
  std::optional<std::array<double, 4>> extent = std::nullopt;
  PointChoice choice = {};  ///< for LAS and LAZ; other files fail with kUsage unless this is the default
  int threads = 0;          ///< for LAS and LAZ; 0: all cores. Never changes the points. DEFAULT: 0.
};

/// Reads points. Scarp's own readers read text with columns (CSV, XYZ), LAS and LAZ (versions 1.0 to 1.4, point formats
/// 0 to 10, COPC; all files of a folder), and LandXML (survey points; points, breaklines and contours of a surface,
/// else its TIN). GDAL reads all other formats (GeoPackage, GeoJSON, Shapefile, DXF, …). Columns are separated by
/// commas, semicolons, tabs or blanks; decimal commas are accepted unless commas separate columns. A header line names
/// the columns. Without a header, the first three columns are x, y and z. A column of consecutive numbers may precede
/// them. Lines that begin with #, % or // are comments. If neither header nor values identify the northing, the call
/// fails and names `columns`. The vertices of lines, such as contours with the height as an attribute or third
/// coordinate, also become points; PointSet::lines stores their order. Curves become chords of at most 4 degrees. Fails
/// with kInput for a missing or empty file, a line without three numbers, a value that is not finite, a feature without
/// a height (the message names the line or feature), polygons, a layer with neither points nor lines, and a damaged or
/// truncated LAS file.
Result<PointSet> read_points(const std::string& path, const ReadPointsOptions& options = {});

struct SpooledPoints {
  PointSet facts;                ///< facts about the points, and those with the least and largest x, y and z
  std::uint64_t duplicates = 0;  ///< points dropped because another one has equal x and y
  std::unique_ptr<PointBlocks> blocks;
};

/// read_points() for LAS and LAZ files, and folders of them, that are larger than memory. The points are sorted into
/// blocks of at most `most_in_block`, in a file without a name in the folder for temporary files, with 48 bytes a
/// point; it vanishes with the blocks. Fails like read_points(); with kUsage for other files, and where x and y would
/// become metres around their middle; with kOutput if there is no space for the file; and with kMemory if a part of
/// 2^-10 of the extent has more points than a block. Does not warn of heights or places that are far from all others.
Result<SpooledPoints> spool_points(std::span<const std::string> paths, const ReadPointsOptions& options,
                                   DuplicatePolicy duplicates, std::uint64_t most_in_block);

/// True if `path` names points rather than a raster. The ending decides, in upper or lower case: .las .laz .csv .tsv
/// .xyz .geojson .geojsonl .shp .fgb .gml .kml .parquet; .txt and .dat unless they begin like an ASCII grid; .gpkg
/// unless it holds a raster; LandXML and DXF without triangles; a folder of LAS and LAZ files without rasters. Text
/// with columns counts as a raster if its points are nodes of a lattice, in any order. No point may be off the lattice
/// or a duplicate. Two thirds of the points must have neighbours in both directions, and a twentieth of all nodes must
/// be points.
bool is_point_file(const std::string& path);

/// For signal handlers that call unlink(): the current temporary names of write_file() and write_files(), in
/// kPendingOutputs slots; an unused slot is empty. Extra names are omitted. Returns a pointer to a static buffer;
/// async-signal-safe.
inline constexpr int kPendingOutputs = 128;
const char* pending_output(int place = 0);
/// For signal handlers: the state of renaming in write_files(). If a program ends while the state is kNow, only some of
/// the files exist. Async-signal-safe.
enum class Naming { kNotYet, kNow, kDone };
Naming outputs_naming();

/// 8-bit RGB, row-major, top row first.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Result<std::vector<std::uint8_t>> encode_png(const Picture& picture);
enum class ImageFormat { kPng, kJpeg, kWebp };
/// The file's bytes, encoded by GDAL; JPEG and WebP with quality 90. Fails with kOutput.
Result<std::vector<std::uint8_t>> encode_image(const Picture& picture, ImageFormat format);

// GLB files: compression and images.

/// An encoded image: PNG, JPEG or WebP.
struct GlbImage {
  std::vector<std::uint8_t> bytes;  ///< EMPTY: no image
  std::string mime_type = "image/png";
};

struct GlbOptions {
  /// Quantises (KHR_mesh_quantization) and compresses (EXT_meshopt_compression, version 0 of the codec). Positions do
  /// not change: x and y are 16-bit multiples of a step of at least 1/256 of `cell`, and z is a 16-bit multiple of a
  /// power of two. A mesh or an axis that does not fit such multiples remains float32, but is also compressed.
  /// simplify() with Output::lattice makes meshes that fit. Texture coordinates (16 bits), normals (12 significant bits
  /// a component) and colours (16 bits, linear) are rounded. Triangles and vertices are ordered for the fewest bytes.
  bool compress = false;
  /// Sides of a cell of the raster along x and y, of either sign: Frame::affine[1] and [5]. DEFAULT: none.
  std::array<double, 2> cell{0, 0};
  GlbImage base_color = {};  ///< draped over the mesh by its uvs; without an image, a mesh with uvs gets one white
                             ///< pixel
  /// Tangent-space normals at the mesh's uvs. They replace Mesh::normals: every vertex has the normal (0, 0, 1) and the
  /// tangent (1, 0, 0). So red, green and blue are x, y and z of the surface's normal in all triangles.
  GlbImage normal_map = {};
  int threads = 1;  ///< 0: all cores. Never changes the bytes. DEFAULT: 1.
};

/// True if this build has libmeshoptimizer and can `compress`.
bool can_compress_glb();

/// Returns the bytes of a GLB file; with default options, they equal those of encode_mesh(). Fails with kOutput as
/// encode_mesh() does, for images without uvs, and for `compress` if libmeshoptimizer is missing or positions are
/// neither on the lattice nor float32. Fails with kInput if memory runs out.
Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh, const GlbOptions& options);

// Images draped over a raster.

/// An image of the area of a raster. Its corners are those of the uv square (Mesh::uvs).
struct Drape {
  Picture picture;
  double covered = 1;                 ///< share of pixels that have a colour in the file; the other pixels are white
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// Reads an image of 8 bits (grey, a palette, or red green blue; pixels of alpha 0 or nodata have no colour) and
/// resamples it bilinearly to the raster's area, from any CRS and grid. `size`: pixels on the longer side; 0: as many
/// as the file has on the raster, at most 8192. An image without georeference is stretched over a raster without
/// georeference or, with a warning, over any raster with as many columns and rows as the image. Uses GDAL. Fails with
/// kInput for a missing file, an image that is not of 8 bits or does not overlap the raster, a CRS without a
/// transformation and, except in these cases, a missing georeference of image or raster.
Result<Drape> read_drape(const std::string& path, const RasterInfo& raster, int cols, int rows, int size = 0,
                         const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
