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
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

// The formats of mesh files: one table, which options, help, completions, messages, writers and readers ask.

/// The frame of a mesh if no CRS is chosen.
enum class DefaultFrame {
  kLocal,   ///< around the raster's centre: for viewers, whose numbers are short
  kMetric,  ///< local for degrees, else the raster's own CRS: for files that hold doubles, and a shape in space
  kSource,  ///< the raster's own CRS, degrees too: for files drawn on maps
};

/// In which unit the heights of a field are. Heights without a declared unit are in the unit of the CRS's x and y where
/// that is a length, else in metres.
enum class HeightsIn {
  kFrame,   ///< metres in the local frame of a CRS and in space, else as in the file
  kMetres,  ///< metres in every frame: for files that are in metres by their specification
  kFile,    ///< in the unit of the file
};

/// In the order of the table.
enum class MeshFormat { kGlb, kObj, kPly, kStl, kTin, k2dm, kVtu, kVtp, kLandXml, kDxf, kGpkg, k3mf, kMsh };

/// The facts about a format that do not depend on a mesh. A format with none of a field's features omits the field.
struct MeshFormatTraits {
  MeshFormat format;
  const char* name;             ///< "landxml", for --of; one of the endings
  const char* title;            ///< "LandXML": for sentences
  const char* endings;          ///< "xml landxml": endings of file names, the usual one first
  const char* shared = "";      ///< the ending that files of other kinds have, too: "xml"
  const char* media_type = "";  ///< empty: none is registered
  const char* contents;         ///< parts of a file, in a few words
  const char* read_by;          ///< programs that read it

  // The place of a mesh.
  DefaultFrame frame = DefaultFrame::kMetric;  ///< frame of x and y unless a CRS is asked for
  HeightsIn heights = HeightsIn::kFrame;
  char up = 'z';                     ///< the axis that points up, 'y' or 'z'
  bool has_choice_of_up = false;     ///< --up chooses the axis; `up` is what most readers expect
  bool is_float32 = false;           ///< positions are offsets from the origin, rounded to float32; else doubles
  bool has_lengths_only = false;     ///< refuses degrees
  bool has_projection_file = false;  ///< has no place for a CRS that all its readers use: a .prj file holds it

  // Contents of a file in addition to triangles.
  bool holds_attributes = false;  ///< normals, uvs, colours
  bool holds_zones = false;       ///< materials and node strings: MeshZones
  bool holds_prints = false;      ///< millimetres, to those who print it
  bool holds_solids_only = false;
  bool holds_space = true;  ///< its z need not be the height

  bool is_read = true;                   ///< decode_mesh() reads it; else it is only written
  bool counts_in_int32 = false;          ///< its readers count vertices and triangles in signed 32-bit numbers
  std::uint64_t bytes_per_vertex = 260;  ///< about what writing needs for a vertex and its two triangles, the file's
                                         ///< bytes included
};

/// All formats, in the order of MeshFormat.
std::span<const MeshFormatTraits* const> mesh_formats();
/// REQUIRES: `format` is one of MeshFormat's names.
const MeshFormatTraits& traits_of(MeshFormat format);

/// From a name ("glb", "OBJ", "landxml", …) or from a path's extension (".xml" is LandXML); nothing if unknown.
std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path);
/// The format of a mesh file that decode_mesh() reads, by the ending of its name; where files of other kinds share that
/// ending, by its first bytes as well. Nothing for other files.
std::optional<MeshFormat> find_mesh_file(const std::string& path);

struct MeshZones;

enum class Decode { kNone, kTerrarium, kMapbox };

/// Several rasters, a part or a coarser version of one, read as a raster.
struct RasterView {
  /// Rasters that make one mosaic with the first. Where several have a value, that of the last one counts; where none
  /// has, the sample is missing. They have one CRS and vertical datum, one number of bands and unit, and lie on one
  /// grid; each has its own sample type, nodata value, mask, scale and offset. Those on both sides of the 180th
  /// meridian lie side by side.
  std::vector<std::string> more = {};
  /// xmin, ymin, xmax, ymax in the units of the raster's CRS: only the cells that overlap this rectangle.
  std::optional<std::array<double, 4>> extent = std::nullopt;
  /// Cells of about this size, in the units of the CRS: k × k cells become one, whose sample is the mean of the valid
  /// ones, with k such that the new cell is not larger. Columns and rows that remain at the right and the bottom are
  /// omitted.
  std::optional<double> resolution = std::nullopt;

  bool is_whole() const { return more.empty() && !extent && !resolution; }
};

struct ReadOptions {
  int band = 1;                                 ///< 1-based
  std::optional<double> nodata = std::nullopt;  ///< overrides the file's value, which then is an ordinary height
  Decode decode = Decode::kNone;  ///< heights packed into red, green, blue (8 bit each); alpha 0 is nodata
  /// Frame of the mesh. Empty (DEFAULT): `default_frame`, the grid frame without georeference. "source": the raster's
  /// own coordinates. "local": metres around the raster's centre. "grid": columns and rows.
  /// "enu", or a geocentric CRS ("EPSG:4978"): a frame in space, where the earth is round (Frame::space).
  /// Anything else is a CRS for GDAL ("EPSG:32611", "32611", WKT, PROJ string).
  std::string crs = {};
  DefaultFrame default_frame = DefaultFrame::kLocal;
  /// A height is z_scale · value + z_offset, where the value is the file's, with its own scale and offset applied. All
  /// heights of the field, its range and its errors are these. nodata is the file's value. DEFAULT: as in the file.
  double z_scale = 1, z_offset = 0;  ///< finite; z_scale is not 0
  /// The unit of these heights, before they become metres: "m", "ft", "us-ft" … or the file's own word. DEFAULT: the
  /// file's, or that of its vertical CRS; metres where `z_scale` makes metres of it; with another factor it is unknown.
  std::string z_unit = {};
  /// Heights that become metres are multiplied by both at once: RasterInfo::z_scale has the product. kUsage where they
  /// must and are in a unit that is no known length.
  HeightsIn heights_in = HeightsIn::kFrame;
  /// Width of a cell in the mesh, for a raster without georeference or with crs "grid"; the frame is then around the
  /// raster's centre. kUsage with any other frame. DEFAULT: 1, the grid frame.
  std::optional<double> cell_size = std::nullopt;
  /// Memory::limit, 0: the machine's memory. read_height_field() refuses to read a raster that needs more;
  /// open_height_field() keeps as much of it in memory. And progress.
  Run run = {};
  /// open_height_field() reads a streamed raster once through, for the range in its info. DEFAULT: false.
  bool with_range = false;
  /// The samples are tolerances or weights, not heights: a raster without any value is no error, and the warning about
  /// infinities names the file. DEFAULT: false.
  bool as_values = false;
  /// Nodata within so many samples of a height is filled, fill_nodata(), and then counts as heights; the range in the
  /// info is that of before. Fails with kInput for a raster of which the memory limit does not hold the samples as
  /// floats. DEFAULT: 0, it stays nodata.
  double fill_distance = 0;
  /// Enclosed voids, 8-connected nodata that does not reach the raster's edge, of at most so many samples a side are
  /// filled as fill_nodata() does, in memory or while windows are read: RasterInfo::voids. DEFAULT: 0, they stay.
  int void_side = 0;
  /// Read by GDAL in every case. Fails with kInput for rasters that make no mosaic or that do not overlap the extent,
  /// and with kUsage for an extent or a resolution without a georeference whose x runs east and whose y runs north or
  /// south. DEFAULT: one raster as it is.
  RasterView view = {};
};

/// Reads one raster. Scarp's own readers read PGM (P2, P5) and Scape's STM; GDAL reads all else, with any path or URL
/// that it opens (/vsicurl/, /vsizip/, http:// and https:// included), but for HDF4, whose library crashes on damaged
/// files. Standard input ("-") and pipes are read once to their end, into a file without a name in the folder for
/// temporary files.
/// nodata (declared, overridden, mask band, alpha, NaN, ±infinity) becomes NaN.
/// Fails with kInput: missing, not a raster, truncated, fewer than 2×2 samples, band out of range, no valid sample;
/// kUsage for a CRS that is unknown or cannot be reached.
Result<OwnedHeightField> read_height_field(const std::string& path, const ReadOptions& options = {});

/// The samples next to a part of a raster, for Border::beyond: of a `field` that read_height_field() read with an
/// extent (ReadOptions::view), the cells next to it that the raster, or the mosaic, continues with. Not known where it
/// ends, and without an extent. Not filled. Fails as read_height_field().
Result<BeyondEdges> read_beyond(const std::string& path, const ReadOptions& options, const RasterInfo& info, int cols,
                                int rows);

/// The position of a mesh in the coordinates of its raster's file.
struct PlaceInSource {
  /// From x and y of the mesh: source x = t[0] + t[1]·x + t[2]·y, source y = t[3] + t[4]·x + t[5]·y.
  std::array<double, 6> to_source{0, 1, 0, 0, 0, 1};
  std::string crs;  ///< CRS of the source, as RasterInfo::crs; empty if it has none

  /// Source coordinates of x = 0, y = 0.
  std::array<double, 2> origin() const { return {to_source[0], to_source[3]}; }
};
/// Nothing for frames that are not affine. Without georeference the source's coordinates are those of the grid frame.
std::optional<PlaceInSource> place_in_source(const Frame& frame, const RasterInfo& info, int rows);

/// True if ReadOptions::crs asks for a frame in space, by "enu" or by a geocentric CRS. False in a build without GDAL.
bool is_in_space(const std::string& crs);

/// The CRS as the text of a .prj file (ESRI's WKT, one line); nothing if it is unknown, and in a build without GDAL.
std::optional<std::string> projection_text(const std::string& crs);

/// Opens one raster of any size, for simplify() and measure(). If the memory limit holds its samples as floats (4 bytes
/// each) they are read as by read_height_field(). If it holds 16-bit samples as they are (2 bytes each: Byte, Int16 and
/// UInt16 without a mask other than nodata) they are read so, and the field has a source. Else the raster is streamed:
/// samples stay in their file, and the source reads them window by window, one window at a time, through GDAL's block
/// cache, whose size is the memory limit and 8 MB (unless GDAL_CACHEMAX is set). A file whose rows of blocks fit twice
/// is decoded once or twice a pass, else again for every few rows.
///
/// A streamed raster has no range in its info unless options.with_range is set, its infinities are nodata without a
/// warning, and a file without any height is no error. But samples that may not fit float32 (32-bit and larger
/// integers, float64, scaled ones) are read once through in any case, since sample_rounding must be known. The samples
/// are those of read_height_field(). Fails as it does, also for a PGM or STM larger than the memory limit, since these
/// are read as a whole.
Result<OwnedHeightField> open_height_field(const std::string& path, const ReadOptions& options = {});

/// The bands of an image as channels: one value a sample and band.
struct OwnedChannels {
  int cols = 0, rows = 0;
  std::vector<std::vector<float>> bands;  ///< each row-major, cols·rows; nodata is NaN
  bool is_8bit = false;                   ///< bytes in the file
  bool is_color = false;                  ///< three bands, red green blue
  Frame frame;
  RasterInfo info;
};

/// Reads all bands of an image (or only `band` of the options, if `all_bands` is false) by GDAL; PGM and STM also
/// without GDAL. Palettes become red, green, blue. `info` counts samples with a value in every band as valid; its range
/// is over all bands. Fails as read_height_field() (options.crs "grid" cannot fail), and with kInput for more
/// than kMaxChannels bands, for an alpha band among them, and for packed heights (options.decode).
Result<OwnedChannels> read_channels(const std::string& path, const ReadOptions& options = {}, bool all_bands = true);

/// Longitude and latitude in degrees of a place in a CRS as RasterInfo and PointSet name it: in WGS 84 where there is a
/// way to it, else in the CRS's own longitude and latitude. Nothing where the CRS is empty or unknown, or PROJ knows no
/// way, and in a build without GDAL.
std::optional<std::array<double, 2>> find_degrees(const std::string& crs, double x, double y);

/// Nothing if two rasters lie on the same grid; else what differs, as the second half of a sentence ("is 10 x 20
/// samples instead of 30 x 40", "is in EPSG:32611 instead of EPSG:4326", "begins at …"). A raster without georeference
/// fits any of its size.
std::optional<std::string> find_grid_difference(const RasterInfo& raster, int cols, int rows, const RasterInfo& other,
                                                int other_cols, int other_rows);

/// The steps of a script for samples, in the order of its lines.
struct Script {
  std::vector<SampleAt> inserted;  ///< for Features::points
  std::vector<SampleAt> ignored;   ///< for Tolerances::ignored

  std::size_t size() const { return inserted.size() + ignored.size(); }
};

/// Reads a script (Terra's -s): a step a line, "s x y" inserts, "i x y" ignores, "u x y" marks the height as unknown
/// (as i); x and y are column and row from the top left. Empty lines and # comments are skipped. Fails with kInput for
/// an unknown word, a missing number, a position outside cols × rows (names the line), and for a sample that one line
/// inserts and another ignores (names both).
Result<Script> read_script(const std::string& path, int cols, int rows);

/// A raster to be written: row-major, NaN is nodata.
struct RasterImage {
  std::span<const float> samples;
  int cols = 0, rows = 0;
  const RasterInfo* like = nullptr;  ///< georeference, CRS and unit are copied from it; may be null
};
enum class RasterFormat { kGeoTiff, kPgm };
/// The file's bytes. GeoTIFF: float32, DEFLATE, nodata NaN. PGM: P5 of 16 bits, samples rounded to whole numbers, which
/// must lie in 0 … 65535 (kOutput otherwise), 65535 for NaN.
Result<std::vector<std::uint8_t>> encode_raster(const RasterImage& raster, RasterFormat format);

/// A GeoTIFF as encode_raster() makes it, of a raster that is not in memory as a whole: rows are added one after the
/// other to a file with a temporary name, which write_files() gives its own; without that nothing is left of it. The
/// bytes are those of encode_raster().
class RasterFile {
 public:
  /// Fails as write_file() and encode_raster() do.
  static Result<RasterFile> create(const std::string& path, int cols, int rows, const RasterInfo* like,
                                   bool overwrite = true);
  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;
  ~RasterFile();

  /// The next row, from the top. Fails with kOutput.
  Result<void> add(std::span<const float> row);
  /// Fails with kOutput. REQUIRES: all rows were added.
  Result<void> finish();
  std::uint64_t size() const;            ///< size of the file; after finish()
  static std::uint64_t bytes(int cols);  ///< bytes of memory that one uses

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  explicit RasterFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Largest number of samples that fit `memory_limit` bytes at 5 bytes a sample; 0 = the machine's memory.
std::uint64_t max_samples(std::uint64_t memory_limit);

/// A chain of edges: where water flows in, a cross-section, the crest of a dam.
struct NodeString {
  std::string name;                  ///< name of the line
  std::vector<std::uint32_t> nodes;  ///< vertices, neighbours joined by edges; a closed one ends with its first
};

/// encode_mesh() writes them where the format has a place for them (MeshFormatTraits::holds_zones). A 2DM file has
/// materials in E3T cards, and node strings in NS cards of ten nodes at most, the last one negative and followed by the
/// string's number, counted from 1.
struct MeshZones {
  std::vector<std::uint32_t> materials;  ///< one for each triangle. EMPTY: all are 1
  std::vector<NodeString> node_strings;  ///< EMPTY: none
};

/// Choices of a writer, and contents of a mesh file in addition to the mesh.
struct EncodeOptions {
  bool double_positions = false;     ///< PLY: doubles even where float32 is exact
  const MeshZones* zones = nullptr;  ///< materials and node strings, of MeshFormatTraits::holds_zones; null: none
};

/// The file's bytes. GLB: y up (x, z, −y), float32, origin as node translation, metadata in asset.extras. OBJ: text,
/// absolute coordinates that read back to the same doubles, metadata as comments. PLY: binary little-endian,
/// absolute. STL: binary, float32 offsets from the origin, z up. TIN: text, absolute coordinates that read back to the
/// same doubles. 2DM, LandXML, DXF: text, absolute coordinates that read back to the same doubles. VTU, VTP: double,
/// absolute, raw little-endian arrays behind the XML. GeoPackage: double, absolute, in the CRS that metadata["crs"]
/// names. Colours, uvs and channels where the format has fields for them: GLB (COLOR_0 as linear float, TEXCOORD_0,
/// _CHANNEL_n where colours do not hold all of it), PLY (red green blue uchar, s t float, channel_n float), OBJ (vt,
/// colours behind the coordinates), VTU and VTP (Colors, TCoords, channel_n); they read back the same, but for PLY's t
/// = 1 − v, rounded to float32. 3MF: as encode_3mf() with one object. Deterministic; a GeoPackage's bytes also depend
/// on the versions of GDAL and SQLite, a 3MF file's on that of zlib. Fails with kOutput where the format cannot hold
/// the mesh: more vertices or triangles than signed 32-bit numbers count in 2DM and LandXML; degrees, a unit that
/// LandXML does not know, or heights in another unit than x and y in LandXML.
///
/// PLY has float32 positions where every one is exactly a float32, as in the local frame, else doubles, as with
/// `double_positions`. A mesh that turn_y_up() has turned can be OBJ, PLY or STL; decode_mesh() turns it back.
Result<std::vector<std::uint8_t>> encode_mesh(const Mesh& mesh, MeshFormat format, const EncodeOptions& options = {});
/// A 3MF file (core specification 1.2) of one or more solids, each an object named by its metadata["name"]: positions
/// rounded to float32 and written so that they read back the same, offsets from the origin of the first object; its
/// other metadata as the file's. The unit is the millimetre if metadata["placement"] shows that the solid was placed
/// (place_mesh()), else the metre. Fails with kOutput for a mesh that is no closed 2-manifold once its positions are
/// rounded (measure_solid()).
Result<std::vector<std::uint8_t>> encode_3mf(std::span<const Mesh> objects);
/// One GLB file of several, levels of detail of one thing, the finest first (MSFT_lod): nodes NAME_LOD0, NAME_LOD1 …,
/// of which the first is the scene's and names the others. Each level stays until the whole covers less than 1 / ratio²
/// of the screen that it had to cover for the level before; for the finest that is 1. REQUIRES: encode_mesh() made the
/// files; `ratio` above 1. Fails with kOutput above 4 GiB.
Result<std::vector<std::uint8_t>> join_glb_levels(std::span<const std::vector<std::uint8_t>> levels, double ratio);
/// One GLB file of several side by side: all nodes are the scene's, and the file's metadata are those of the first.
/// REQUIRES: encode_mesh() or encode_glb() made the files. Fails with kOutput above 4 GiB.
Result<std::vector<std::uint8_t>> join_glbs(std::span<const std::vector<std::uint8_t>> files);
/// How the numbers of a mesh file are to be read: what the mesh, which is z up and absolute, no longer shows.
struct MeshFileAxes {
  char up = 0;               ///< 'y' or 'z'; 0 if neither the format nor the file declares it, and z is assumed
  bool has_offsets = false;  ///< positions in the file are offsets from Mesh::origin (GLB, STL, 3MF)
};
/// Reads any of these formats but GeoPackage; recognises the format by content. `axes`, if given, receives the axes of
/// the file. Fails with kInput. Never trusts a length or an index in the file.
Result<Mesh> decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors,
                         MeshFileAxes* axes = nullptr);

/// encode_mesh() to a temporary name next to `path`, then renamed; no file remains on failure.
/// Fails with kOutput, also if `path` exists and `overwrite` is false.
Result<void> write_mesh(const Mesh& mesh, const std::string& path, std::optional<MeshFormat> format = {},
                        bool overwrite = true);
/// decode_mesh() of a file.
Result<Mesh> read_mesh(const std::string& path, MeshFileAxes* axes = nullptr);

/// Writes bytes to a temporary name next to `path` (".scarp-R.tmp", R: 16 random hexadecimal digits) and renames it.
/// kOutput on any failure, with no file remaining; also if `path` exists and `overwrite` is false. A symbolic link is
/// followed, also to a file that does not exist yet; an existing file keeps its permissions. Standard output ("-",
/// /dev/stdout), and existing devices and pipes, are written directly; a pipe without a reader is kOutput after two
/// seconds. A program should ignore SIGXFSZ to receive "file too large" as an error instead of being killed.
Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes, bool overwrite = true);
struct FileBytes {
  std::string path;
  std::span<const std::uint8_t> bytes;
  RasterFile* raster = nullptr;  ///< finished, in place of bytes; it was created for the path
};
/// write_file() for several files that belong together. All are written to temporary names before the first is renamed,
/// so a full disk, a read-only folder or a name that exists already creates none of them. Devices and pipes are written
/// last.
Result<void> write_files(std::span<const FileBytes> files, bool overwrite = true);
/// The whole file (or pipe). kInput if it cannot be read.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);
/// The files that reading a raster or vector data reads: itself (without its layer, for "FILE:LAYER"), those next to it
/// (.aux.xml, .prj, …), the sources of a VRT, and the archive that it lies in (/vsizip/z.zip/a.tif, /vsitar/…). A file
/// that GDAL cannot open is itself alone. Empty for remote files, what does not exist, and in a build without GDAL.
std::vector<std::string> list_files(const std::string& path);
/// The rasters, those of folders in place of these, put together to mosaics: neighbours in the list that lie on one
/// grid, have one type and one nodata value, and one CRS, its datum of heights included. A raster that cannot be opened
/// stands alone.
std::vector<std::vector<std::string>> find_mosaics(const std::vector<std::string>& paths);

struct ReadPointsOptions {
  std::string layer = {};  ///< layer of a vector file. DEFAULT: the first one with points, else with lines.
  /// Column or attribute with the height. DEFAULT: the third coordinate, unless it is 0 everywhere and an attribute has
  /// one of the names z, height, elevation, elev, h, alt, ele, hoehe …; where there is none, that attribute.
  std::string z_field = {};
  std::string crs =
      {};  ///< like ReadOptions::crs, "source" and "local" and a CRS; DEFAULT: local metres for degrees, else source
  ProgressCallback progress = {};
  /// The contents of a text's columns: "number,northing,easting,height,code", or as letters "pnezd"; - for one that is
  /// not read. DEFAULT: the names in the header, else guessed from the columns.
  std::string columns = {};
  /// Points of this height have none, nor have those whose height is empty or no finite number: they are omitted and
  /// counted. NaN: only the latter. DEFAULT: the call fails where a height is missing.
  std::optional<double> nodata = {};
  /// Heights and their unit, as in ReadOptions. DEFAULT of z_unit: the unit in the name of the column or attribute
  /// ("elev_ft", "Elevation (mm)"), else the vertical CRS, else the unit of x and y.
  double z_scale = 1, z_offset = 0;
  std::string z_unit = {};
  HeightsIn heights_in = HeightsIn::kFrame;
  /// kLocal, for points without a chosen `crs`: x and y whose unit is not the metre become local metres; others stay,
  /// and the caller moves them to local_origin(): their frame is a local one, too, for `heights_in`.
  DefaultFrame default_frame = DefaultFrame::kMetric;
};

/// Reads points: text of columns (CSV, XYZ: separated by commas, semicolons, tabs or blanks; decimal commas where
/// commas do not separate; a header line names them, else the first three are x, y, z, without a first one that counts;
/// lines that begin with #, % or // are comments), by a reader of our own; all else (GeoPackage, GeoJSON, Shapefile, …)
/// by GDAL. Where neither the header of a text nor its values show which column is the northing, the call fails and
/// names `columns`. The vertices of lines are points, too, and PointSet::lines has their order: contours with the
/// height as an attribute or as third coordinate. Curves become chords of 4 degrees at most. Fails with kInput:
/// missing, empty, a line without three numbers, a value that is not finite, a feature without a height (names the line
/// or feature), polygons, neither points nor lines in the layer.
Result<PointSet> read_points(const std::string& path, const ReadPointsOptions& options = {});

/// True if `path` names points rather than a raster: by its end (.csv .tsv .xyz .geojson .geojsonl .shp .fgb .gml .kml
/// .parquet; .txt and .dat unless they begin as an ASCII grid does; .gpkg unless it holds a raster), in any case. Text
/// of columns is a raster where its points are the nodes of one, in any order, with or without some missing: none lies
/// off the lattice or on another, two of three have one next to them in both directions, and they are a twentieth of
/// all nodes at least.
bool is_point_file(const std::string& path);

/// For signal handlers: the temporary names that write_file() and write_files() hold just now, for unlink(), in
/// kPendingOutputs slots; an unused slot is empty. Points to a static buffer; async-signal-safe. With more files at
/// once, the names of the first ones.
inline constexpr int kPendingOutputs = 128;
const char* pending_output(int place = 0);
/// For signal handlers: whether write_files() is giving its files their names just now, when a program that ends
/// creates only some of them, or has done so. Async-signal-safe.
enum class Naming { kNotYet, kNow, kDone };
Naming outputs_naming();

/// 8-bit RGB, row-major, top row first.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Result<std::vector<std::uint8_t>> encode_png(const Picture& picture);
enum class ImageFormat { kPng, kJpeg, kWebp };
/// The file's bytes, by GDAL's drivers; JPEG and WebP at a quality of 90 of 100. Fails with kOutput.
Result<std::vector<std::uint8_t>> encode_image(const Picture& picture, ImageFormat format);

// GLB files: compression and images.

/// An encoded image: PNG, JPEG or WebP.
struct GlbImage {
  std::vector<std::uint8_t> bytes;  ///< EMPTY: no image
  std::string mime_type = "image/png";
};

struct GlbOptions {
  /// Quantised (KHR_mesh_quantization) and compressed (EXT_meshopt_compression, version 0 of the codec). Positions keep
  /// their values: x and y are 16-bit multiples of 1/256 of `cell` or more, z of a power of two. A mesh or an axis that
  /// does not fit stays float32, which is compressed, too. simplify() makes meshes that fit with Output::lattice.
  /// Texture coordinates (16 bits), normals (12 significant bits a component) and colours (16 bits, linear) are
  /// rounded. Triangles and vertices are put in the order that needs the fewest bytes.
  bool compress = false;
  /// Sides of a cell of the raster along x and y, of either sign: Frame::affine[1] and [5]. DEFAULT: none.
  std::array<double, 2> cell{0, 0};
  GlbImage base_color = {};  ///< draped over the mesh by its uvs; without it a mesh with uvs gets one white pixel
  /// Tangent-space normals by the mesh's uvs. Every vertex then gets the normal (0, 0, 1) and the tangent (1, 0, 0), in
  /// place of Mesh::normals: red is x, green y, blue z of the surface's normal, whatever the triangles.
  GlbImage normal_map = {};
  int threads = 1;  ///< 0: all cores. Never changes the bytes. DEFAULT: 1.
};

/// True if this build can `compress`: it has libmeshoptimizer.
bool can_compress_glb();

/// The bytes of a GLB file. encode_mesh() is this without options. Fails with kOutput as it does, for images without
/// uvs, and for `compress` where positions are neither on the lattice nor float32, or without libmeshoptimizer; with
/// kInput where memory runs out.
Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh, const GlbOptions& options);

// Images draped over a raster.

/// An image on the place of a raster: its corners are those of the raster's image, as Mesh::uvs count.
struct Drape {
  Picture picture;
  double covered = 1;                 ///< share of the pixels that the file has a colour for; the others are white
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// Reads an image of 8 bits (grey, a palette, or red green blue; alpha 0 and nodata are no colour) and resamples it,
/// bilinearly, onto the raster's image, whatever its own CRS and grid; `size`: pixels on the longer side, 0: one for
/// each pixel of the file that lies on the raster, at most 8192. An image without georeference is stretched over a
/// raster that has none, and over any raster of as many samples as it has pixels, with a warning. By GDAL. Fails with
/// kInput: no such file, not of 8 bits, one of the two without a place, not on the raster, a CRS that cannot be
/// reached.
Result<Drape> read_drape(const std::string& path, const RasterInfo& raster, int cols, int rows, int size = 0,
                         const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
