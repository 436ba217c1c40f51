// Describe the heights to simplify: samples on a rectangular grid, borrowed from an array or read through a source, and
// the frame that maps them to the coordinates of the mesh.
//
// Example:
//     const std::vector<float> heights(300 * 200, 12.5f);  // row by row, the first row in the north; NaN is nodata
//     scarp::HeightField field;
//     field.samples = heights.data();  // borrowed
//     field.cols = 300;
//     field.rows = 200;
//     field.frame.kind = scarp::Frame::Kind::kLocal;
//     field.frame.affine = {0, 10, 0, 0, 0, -10};  // 10 m a cell, the first sample at (0, 0), rows go south
//     std::printf("%g to %g\n", scarp::height_range(field).min, scarp::height_range(field).max);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

// The map from the samples of a height field to the coordinates of its mesh.

/// A map of points that is not affine, such as a map projection. Implementations are immutable and may be
/// called from several threads at once.
class PointTransform {
 public:
  virtual ~PointTransform() = default;
  /// Maps the points (x[k], y[k]) in place; x and y have equal sizes. Returns false if any point has no image
  /// (it is then NaN).
  virtual bool apply(std::span<double> x, std::span<double> y) const = 0;
};

/// A map from the raster's x, y and heights into space, where the earth is round. Along a vertical, x and y fixed, it
/// is linear in the height: verticals are straight lines. Implementations are immutable and may be called from several
/// threads at once.
class SpaceTransform {
 public:
  virtual ~SpaceTransform() = default;
  /// Maps the points (x[k], y[k]) at the heights z[k] in place, in metres; the spans have equal sizes. Returns false if
  /// any point has no image (it is then NaN).
  virtual bool to_space(std::span<double> x, std::span<double> y, std::span<double> z) const = 0;
  /// The inverse: back to x, y and heights.
  virtual bool from_space(std::span<double> x, std::span<double> y, std::span<double> z) const = 0;
  /// The point from which float32 positions are offsets.
  virtual std::array<double, 3> origin() const = 0;
  /// Away from the earth at the raster's centre, of unit length.
  virtual std::array<double, 3> up() const = 0;
  /// The earth-centred, earth-fixed position of (x, y, z) of the frame: row k is m[4k]·x + m[4k+1]·y + m[4k+2]·z +
  /// m[4k+3], in metres. Its 3 × 3 part is a rotation.
  virtual std::array<double, 12> to_earth() const = 0;
};

/// How sample (col, row) becomes a point (x, y) of the mesh:
///   x = affine[0] + affine[1]·col + affine[2]·row
///   y = affine[3] + affine[4]·col + affine[5]·row
/// (GDAL's order of terms; integer col, row are sample *centres*), then `transform` where it is set. z is the
/// sample's height. Only a frame in space, where `space` is set, maps x, y and the height together into x, y, z.
///
/// DEFAULT: the grid frame of a raster without georeference, see grid_frame().
struct Frame {
  enum class Kind {
    kGrid,        ///< x = col, y = rows − 1 − row, cell size 1
    kSource,      ///< the raster's own CRS
    kLocal,       ///< metres east and north of the raster's centre, or cells; affine in the grid
    kProjected,   ///< another CRS, reached through `transform`
    kGeocentric,  ///< earth-centred, earth-fixed metres, reached through `space`
    kTangent,     ///< metres east, north and up of the raster's centre on the ellipsoid, reached through `space`
  };
  Kind kind = Kind::kGrid;
  std::array<double, 6> affine{0, 1, 0, 0, 0, -1};
  std::shared_ptr<const PointTransform> transform;  ///< null where the frame is affine, and in space
  std::shared_ptr<const SpaceTransform> space;      ///< null but in space
  std::string crs;                                  ///< CRS of x and y: "EPSG:32611", WKT, or empty where there is none
  std::string description;                          ///< one line for reports: what x and y are, and in which unit
  double unit_in_metres = 0;                        ///< unit of x and y; 0 for degrees and cells, and where it is
                                                    ///< unknown

  bool is_affine() const { return transform == nullptr && space == nullptr; }
  /// Affine part only: the position of the (fractional) sample (col, row).
  std::array<double, 2> apply_affine(double col, double row) const {
    return {affine[0] + affine[1] * col + affine[2] * row, affine[3] + affine[4] * col + affine[5] * row};
  }
  /// Orientation of the affine part: negative for the usual raster whose rows go south.
  double determinant() const { return affine[1] * affine[5] - affine[2] * affine[4]; }
};

/// The frame of a raster with `rows` rows and no georeference: x = col, y = rows − 1 − row.
Frame grid_frame(int rows);

/// Origin that keeps offsets short: the position of the sample (cols / 2, rows / 2) in the frame, or before `space`.
/// Returns {NaN, NaN} if that point has no image.
std::array<double, 2> frame_origin(const Frame& frame, int cols, int rows);

/// True if every sample's offset from frame_origin() is exactly a float32, so that a mesh written with
/// float32 offsets has its vertices exactly on the samples. `steps`: the same for the lattice of `steps` points a
/// sample. False for frames that are not affine. Cost: O((cols + rows) · steps).
bool offsets_are_exact(const Frame& frame, int cols, int rows, int steps = 1);

// From degrees to metres: the frame of a raster in longitude and latitude.

/// The ellipsoid and the unit of longitude and latitude.
struct Geodetic {
  double semi_major = 6378137;                ///< semi-major axis of the ellipsoid, in metres, above 0. DEFAULT: WGS
                                              ///< 84.
  double inverse_flattening = 298.257223563;  ///< inverse flattening of the ellipsoid; 0: a sphere. DEFAULT: WGS 84.
  /// An x or y of 1 in radians. DEFAULT: a degree.
  double radians_per_unit = 0.017453292519943295;
};

/// Metres from the centre to a pole.
inline double semi_minor(const Geodetic& geodetic) {
  return geodetic.inverse_flattening == 0 ? geodetic.semi_major
                                          : geodetic.semi_major * (1 - 1 / geodetic.inverse_flattening);
}

/// Metres along the ground for one unit of x and one of y at a latitude (in units of y); 0, 0 at or beyond a pole.
std::array<double, 2> metres_of_unit(double latitude, const Geodetic& geodetic = {});

/// The local frame of a raster in degrees: metres east and north of its centre sample (cols / 2, rows / 2), which is at
/// 0, 0. `affine` maps samples to longitude and latitude, as Frame::affine does. Degrees become metres by two
/// constants, the ellipsoid's radii of curvature at the centre. So the frame is affine, and a promise on the grid holds
/// in the mesh. Lengths along the centre's parallel and meridian are true; elsewhere lengths from east to west are off
/// by cos φ_centre / cos φ. The cell is rounded so that each sample's x and y is exactly a float32: by less than 0.03 %
/// for 5,000 samples from the centre to the border. Needs no GDAL; read_height_field() makes the same frame from a
/// file's CRS.
///
/// Frame::kind is kLocal, Frame::crs is empty, Frame::description states the centre and the cell.
/// Fails with kUsage for fewer than 1 column or row, an affine map that is not finite, a centre at or beyond a pole,
/// and cells too unequal for float32. Cost: O(1).
Result<Frame> frame_of_degrees(const std::array<double, 6>& affine, int cols, int rows, const Geodetic& geodetic = {});

/// The position of a raster on the globe, and the meaning of its samples.
struct RasterPlace {
  /// From samples to the CRS's x and y, as Frame::affine.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  /// From longitude and latitude in degrees to x and y. Null: x and y are longitude and latitude.
  std::shared_ptr<const PointTransform> from_degrees = nullptr;
  /// The inverse. Null where from_degrees is; without it no samples are shown.
  std::shared_ptr<const PointTransform> to_degrees = nullptr;
};

/// The place of a sample in its raster: column from the left, row from the top.
struct SampleAt {
  std::int32_t col = 0, row = 0;

  friend bool operator==(const SampleAt&, const SampleAt&) = default;
};

/// A further value at each sample, such as a colour: borrowed, on the same grid as the heights.
struct Channel {
  const float* samples = nullptr;  ///< cols·rows values; finite wherever the heights have a value
  double scale = 1;                ///< its error times this is comparable with an error in z units; at least 0
};

/// Samples that are not one array of floats: 16-bit values in memory, a file larger than memory.
class SampleSource {
 public:
  virtual ~SampleSource() = default;
  /// Writes the window of cols × rows samples whose first is (col, row) to `out`, row-major, `stride` floats from row
  /// to row; nodata as NaN. Several threads may call it at once. Fails with kInput, naming file and row. REQUIRES: the
  /// window lies in the raster.
  virtual Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const = 0;
  /// True if any window costs about as much as copying it. False: callers read whole rows, from the top down, each once
  /// or a few times, and small windows only where there is no other way.
  virtual bool is_in_memory() const = 0;
};

/// A source of 16-bit samples in memory, 2 bytes each: `codes` are row-major, and code k stands for the height
/// heights[k], NaN for nodata. REQUIRES: `cols` codes to a row, a height for each code.
std::unique_ptr<SampleSource> make_coded_source(std::vector<std::uint16_t> codes, int cols, std::vector<float> heights);

/// A height field that borrows its samples.
///
/// Samples are row-major, `cols` to a row without padding, the first row at the top (north) of the raster.
/// Sample (col, row) stands for the height at its pixel's centre. NaN and the infinities are never heights; nor
/// is any sample equal to `nodata`.
struct HeightField {
  const float* samples = nullptr;              ///< cols·rows values, owned by the caller, alive while this is used
  int cols = 0;                                ///< at least 2
  int rows = 0;                                ///< at least 2
  std::optional<float> nodata = std::nullopt;  ///< DEFAULT: none besides NaN and ±infinity
  Frame frame = {};  ///< position of the samples in the mesh. DEFAULT: cell size 1, first row at y = 0, going down
  /// Largest |given value − float32 sample| of a source that does not fit float32 (int32, float64). A promise
  /// about the source keeps this much in reserve. DEFAULT: 0.
  double sample_rounding = 0;
  /// At most kMaxChannels. With channels, the error of a sample is the norm of (height_scale · |height error|, scale₁ ·
  /// |error₁|, …). DEFAULT: none.
  std::vector<Channel> channels = {};
  double height_scale = 1;  ///< weight of the height error in that norm, at least 0. DEFAULT: 1.
  /// The source of the samples, borrowed, if `samples` is null. simplify() on heights alone and measure() accept it;
  /// functions that need the samples as one array fail with kUsage. DEFAULT: none.
  const SampleSource* source = nullptr;
};

inline constexpr int kMaxChannels = 64;

/// A height, and how many samples have it.
struct HeightCount {
  double height = 0;
  std::uint64_t samples = 0;
};

/// A height that most likely stands for nodata, though the raster does not declare it: see find_undeclared_nodata().
struct UndeclaredNodata {
  HeightCount of;
  double value = 0;         ///< value in the file that this height is made of
  bool is_high = false;     ///< above all others, not below
  double min = 0, max = 0;  ///< range of the other heights
};

/// Signs that heights packed into colours are wrong: the colours were changed after packing, or are no packed heights
/// at all.
struct PackedDoubts {
  /// Samples that lie off both neighbours in their row, which are close together, by an eighth to one and a half of
  /// what the next colour counts, where that changes: the count if it is typical of interpolation or lossy compression,
  /// else 0. Interpolation is searched for in some rows of a large raster.
  std::uint64_t torn = 0;
  double torn_by = 0;      ///< the farthest of them
  std::string seems = {};  ///< the other encoding, where most heights are none on earth as they are, and are by that
};

/// Missing samples, by ReadOptions::void_side.
struct VoidCount {
  std::uint64_t filled = 0;  ///< samples
  std::uint64_t left = 0;    ///< samples, of larger voids and of those at the raster's edge
  /// The lowest height next to each remaining void: the highest of them. And the highest: the lowest of them.
  double least = 0, most = 0;
};

/// Metadata of a raster that was read.
struct RasterInfo {
  std::string path;
  std::string format;       ///< "GTiff", "PGM", "STM", …
  std::string sample_type;  ///< type in the file: "Int16", "Float32", …
  std::string crs;          ///< CRS of the file, "EPSG:4326" where an authority is known, else WKT; empty if none
  std::string crs_unit;     ///< unit of its x and y: "metre", "US survey foot", "degree"; empty if there is no CRS
  double crs_unit_in_metres = 0;     ///< 0 for degrees, and if there is no CRS
  bool is_geographic = false;        ///< x and y of the file are degrees
  std::string vertical;              ///< the zero of the heights, if the CRS names it: "EGM96 height"; else empty
  bool is_ellipsoidal = false;       ///< true if heights are above the ellipsoid, by the CRS
  std::string crs_with_heights;      ///< WKT of the CRS where `vertical` is set; else empty
  std::string unit;                  ///< unit of z if it is known; else empty
  double unit_in_metres = 1;         ///< length of the unit of z, known or assumed (HeightsIn); 0 for words that are no
                                     ///< known length
  std::string file_unit;             ///< unit of the file's values, if it is known and other than `unit`; else empty
  bool unit_is_assumed = false;      ///< true if the unit of z is not declared, or that of what was made metres
  double scale = 1, offset = 0;      ///< the file's own: such a value is scale · (what it stores) + offset
  double z_scale = 1, z_offset = 0;  ///< heights are z_scale · value + z_offset: ReadOptions, and the way to metres
  std::optional<double> nodata;      ///< the nodata value used, of the file's values
  std::array<double, 6> geotransform{0, 1, 0, 0, 0, 1};  ///< GDAL's, of the pixel *corner*; identity if none
  bool has_georeference = false;
  double cell_x = 1, cell_y = 1;      ///< size of a cell in the units of the file's CRS
  double cell_x_m = 0, cell_y_m = 0;  ///< the same in metres at the centre; 0 if unknown
  bool has_range = true;              ///< false: valid, min and max are not known, for the raster has not been read yet
  std::uint64_t valid = 0;            ///< samples that are heights
  double min = 0, max = 0;            ///< range of the valid samples
  std::vector<UndeclaredNodata> undeclared_nodata;  ///< among them, if has_range
  std::vector<std::string> warnings;                ///< sentences for the user: infinities read as nodata, …
  VoidCount voids = {};                             ///< if has_range, or the samples are in memory
  std::string view = {};  ///< the selection that ReadOptions::view made of the files, in words; empty for one raster as
                          ///< it is
  PackedDoubts packed = {};    ///< set for heights packed into colours
  std::string depths = {};     ///< the sign that the values are depths, which were kept so; else empty
  bool seems_degrees = false;  ///< true if x and y resemble degrees, though the CRS is in lengths, or there is none
};

/// A height field that owns its samples, or their source. nodata samples are NaN.
struct OwnedHeightField {
  std::vector<float> samples;  ///< empty if there is a `source`
  int cols = 0;
  int rows = 0;
  Frame frame;
  double sample_rounding = 0;
  RasterInfo info;
  std::shared_ptr<const SampleSource> source = nullptr;  ///< see open_height_field(). DEFAULT: none.
  /// The samples of a caller who lent them, in place of `samples`; they are never changed. DEFAULT: none.
  const float* lent = nullptr;

  /// Borrows this object's samples: valid while it is alive and `samples` is not resized.
  HeightField view() const {
    const float* const held = lent != nullptr ? lent : samples.data();
    return {source ? nullptr : held, cols, rows, std::nullopt, frame, sample_rounding, {}, 1, source.get()};
  }
  /// Copies samples that are lent, so that they can be changed.
  void own() {
    if (lent == nullptr) return;
    samples.assign(lent, lent + static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
    lent = nullptr;
  }
  operator HeightField() const { return view(); }  // NOLINT: the function accepts both
};

/// Number, minimum and maximum of the samples that are heights. min = max = 0 if there are none, and for a field whose
/// samples are not in memory: see Measurement::heights for these.
struct HeightRange {
  static constexpr std::size_t kEnds = 6;

  std::uint64_t valid = 0;
  double min = 0, max = 0;
  /// The lowest and the highest heights, each once, from the outermost inwards, and how many samples have each; as far
  /// as there are so many, else of 0 samples.
  std::array<HeightCount, kEnds> lowest{}, highest{};

  /// Adds the samples of another part of the raster.
  void add(const HeightRange& part);
};
HeightRange height_range(const HeightField& field, int threads = 1);

/// `scale`, `offset`: a height is scale · value + offset, and signs are values.
/// The heights at either end of the range that most likely stand for nodata. A height does where it is far from all
/// others within:
/// - a usual sign for nodata (-999, -10000, -32768; 9999, 99999, 999999, 32767, 65535 and 1e20 or more, below 0 or
///   above), by a
///   fifth of the others' range;
/// - 0, by a twentieth of it and by at least 10, where a thousandth of the samples has it: a sea that honestly lies at
/// 0
///   has a shore that is not much higher;
/// - another whole number, such as -99, by their range, where a thousandth of the samples or more has it, 10 at least
///   and no more than half;
/// - any other, by 50 times their range, where at most a hundredth of the samples has it.
/// The others must differ, and more heights than HeightRange::kEnds − 1 at one end are not seen through. Cost: O(1).
std::vector<UndeclaredNodata> find_undeclared_nodata(const HeightRange& range, double scale = 1, double offset = 0);

/// From samples to the map coordinates of lines: those of the raster's file, or x = col, y = rows − 1 − row if the file
/// has none.
std::array<double, 6> map_affine(const RasterInfo& info, int rows);

/// Fills nodata by interpolation: each nodata sample within `max_distance` samples (Euclidean, along the eight compass
/// directions) of a valid one becomes the mean of the nearest valid samples in those directions, weighted by inverse
/// squared distance. Samples farther away stay nodata. Returns the number of samples filled.
/// REQUIRES: max_distance > 0; the samples are in memory (those of a source stay as they are). Cost: O(cols·rows), 16
/// extra bytes for each nodata sample.
std::uint64_t fill_nodata(OwnedHeightField& field, double max_distance);

/// Gives every nodata sample the height `value`. Returns the number of samples filled. REQUIRES: as fill_nodata().
std::uint64_t fill_background(OwnedHeightField& field, float value);

// Samples changed by lines.

/// A sample that a breakline changed.
struct SampleEdit {
  std::int32_t col = 0, row = 0;
  float before = 0, after = 0;
};

/// `source` with the changed samples of Simplified::edits. The promise of a mesh with hard lines refers to these
/// samples. `edits`: in raster order, of valid samples. Cost: that of a window, and a search for its first edit in each
/// row.
std::shared_ptr<const SampleSource> edit_source(std::shared_ptr<const SampleSource> source,
                                                std::vector<SampleEdit> edits);

/// Applies the edits to `field`, in memory or by edit_source(). Without edits nothing changes. `edits`: as above. Cost:
/// O(edits).
void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field);

// Scattered samples as values.

/// A line through points of a set: a contour, a ridge, the foot of a dam.
struct PointLine {
  std::vector<std::uint32_t> points;  ///< indices; at least two, successive ones differ; a ring ends with its first
  std::string name;                   ///< for messages: "contours.gpkg feature 12"
};

/// Samples anywhere: z over (x, y), in one plane coordinate system. x east, y north.
struct PointSet {
  std::vector<double> x, y, z;   ///< coordinates, of equal size; all finite
  std::vector<PointLine> lines;  ///< lines that no triangle crosses. EMPTY: the points are scattered
  std::string path;              ///< their source, for messages
  std::string format;            ///< "CSV", "GPKG", …
  std::string crs;               ///< CRS of x and y: "EPSG:32611", WKT, or empty
  std::string description;       ///< one line for reports: what x and y are, and in which unit
  bool is_local = false;         ///< x and y are metres around the middle of the points
  double unit_in_metres = 0;     ///< unit of x and y; 0 for degrees, and where it is unknown
  /// Known facts about z, like those about a raster's heights: unit, unit_in_metres, unit_is_assumed, file_unit,
  /// z_scale, z_offset; and crs_unit, crs_unit_in_metres of x and y in the file.
  RasterInfo heights = {};
  std::vector<std::string> warnings;
  std::string columns;               ///< one line for reports: how each column was read, or where heights come from
  std::uint64_t without_height = 0;  ///< number omitted, as ReadPointsOptions::nodata asks
  bool is_geographic = false;        ///< for points that are lent: without a CRS that GDAL knows, x and y are degrees

  std::size_t size() const { return x.size(); }
};

/// Rule for several points at one place: with equal x and equal y as given.
enum class DuplicatePolicy { kFirst, kLast, kHighest, kLowest, kMean };

/// How the convex hull fits points.
struct HullFit {
  double bridged = 0;          ///< share of its area that lies across bays, where no points are
  std::uint64_t slivers = 0;   ///< long steep triangles at it, where the points' rim is nearly straight
  double boundary_length = 0;  ///< for a mesh that ends at the points instead; 0: the hull fits
};

}  // namespace scarp

#pragma GCC visibility pop
