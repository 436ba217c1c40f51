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

// Maps from the samples of a height field to the coordinates of its mesh.

/// A non-affine map of points, such as a map projection. Implementations are immutable and thread-safe.
class PointTransform {
 public:
  virtual ~PointTransform() = default;
  /// Maps the points (x[k], y[k]) in place; x and y have equal sizes. Points without an image become NaN, and the call
  /// returns false.
  virtual bool apply(std::span<double> x, std::span<double> y) const = 0;
};

/// A map from the raster's x, y and heights into space, where the earth is round. For fixed x and y the map is linear
/// in the height: verticals are straight lines. Implementations are immutable and thread-safe.
class SpaceTransform {
 public:
  virtual ~SpaceTransform() = default;
  /// Maps the points (x[k], y[k]) at the heights z[k] in place, in metres; the spans have equal sizes. Points without
  /// an image become NaN, and the call returns false.
  virtual bool to_space(std::span<double> x, std::span<double> y, std::span<double> z) const = 0;
  /// The inverse map, to x, y and heights.
  virtual bool from_space(std::span<double> x, std::span<double> y, std::span<double> z) const = 0;
  /// The point to which float32 positions are relative.
  virtual std::array<double, 3> origin() const = 0;
  /// The unit vector that points away from the earth at the raster's centre.
  virtual std::array<double, 3> up() const = 0;
  /// The matrix m from the frame to earth-centred, earth-fixed metres: coordinate k of a position is m[4k]·x +
  /// m[4k+1]·y + m[4k+2]·z + m[4k+3]. Its 3 × 3 part is a rotation.
  virtual std::array<double, 12> to_earth() const = 0;
};

/// The map from sample (col, row) to a point (x, y) of the mesh:
///   x = affine[0] + affine[1]·col + affine[2]·row
///   y = affine[3] + affine[4]·col + affine[5]·row
/// (The terms are in GDAL's order; integer col, row are sample *centres*.) Then `transform`, if set, is applied. z is
/// the sample's height, except in a frame in space: `space` then maps x, y and height together to x, y, z.
///
/// DEFAULT: the frame of a raster without georeference, see grid_frame().
struct Frame {
  enum class Kind {
    kGrid,        ///< x = col, y = rows − 1 − row, cell size 1
    kSource,      ///< the raster's own CRS
    kLocal,       ///< metres east and north of the raster's centre, or cells; affine
    kProjected,   ///< another CRS, reached through `transform`
    kGeocentric,  ///< earth-centred, earth-fixed metres, reached through `space`
    kTangent,     ///< metres east, north and up of the raster's centre on the ellipsoid, reached through `space`
  };
  Kind kind = Kind::kGrid;
  std::array<double, 6> affine{0, 1, 0, 0, 0, -1};
  std::shared_ptr<const PointTransform> transform;  ///< null for affine frames and frames in space
  std::shared_ptr<const SpaceTransform> space;      ///< null except in space
  std::string crs;                                  ///< CRS of x and y: "EPSG:32611", WKT, or empty
  std::string description;                          ///< one line for reports: the meaning and unit of x and y
  double unit_in_metres = 0;                        ///< unit of x and y; 0 for degrees, cells and unknown units

  bool is_affine() const { return transform == nullptr && space == nullptr; }
  /// Affine part only: the position of the (fractional) sample (col, row).
  std::array<double, 2> apply_affine(double col, double row) const {
    return {affine[0] + affine[1] * col + affine[2] * row, affine[3] + affine[4] * col + affine[5] * row};
  }
  /// Orientation of the affine part: negative for the usual raster, whose rows run south.
  double determinant() const { return affine[1] * affine[5] - affine[2] * affine[4]; }
};

/// The frame of a raster with `rows` rows and no georeference: x = col, y = rows − 1 − row.
Frame grid_frame(int rows);

/// The origin that keeps offsets short: the position of the sample (cols / 2, rows / 2) in the frame, before `space` is
/// applied. Returns {NaN, NaN} if that point has no image.
std::array<double, 2> frame_origin(const Frame& frame, int cols, int rows);

/// True if float32 holds every sample's offset from frame_origin() exactly, so that a mesh written with float32 offsets
/// has its vertices exactly on the samples. The check covers positions at multiples of 1 / `steps` sample. False for
/// non-affine frames. Cost: O((cols + rows) · steps).
bool offsets_are_exact(const Frame& frame, int cols, int rows, int steps = 1);

// From degrees to metres: the frame of a raster in longitude and latitude.

/// The ellipsoid and the unit of longitude and latitude.
struct Geodetic {
  double semi_major = 6378137;                ///< semi-major axis in metres, above 0. DEFAULT: WGS 84.
  double inverse_flattening = 298.257223563;  ///< inverse flattening of the ellipsoid; 0: a sphere. DEFAULT: WGS 84.
  /// The unit of x and y in radians. DEFAULT: a degree.
  double radians_per_unit = 0.017453292519943295;
};

inline double semi_minor(const Geodetic& geodetic) {
  return geodetic.inverse_flattening == 0 ? geodetic.semi_major
                                          : geodetic.semi_major * (1 - 1 / geodetic.inverse_flattening);
}

/// Lengths on the ground, in metres, of one unit of x and one unit of y at a latitude (in units of y); {0, 0} at or
/// beyond a pole.
std::array<double, 2> metres_of_unit(double latitude, const Geodetic& geodetic = {});

/// The local frame of a raster in degrees: metres east and north of its centre sample (cols / 2, rows / 2), which is at
/// 0, 0. `affine` maps samples to longitude and latitude, as Frame::affine does. Two constants, the ellipsoid's radii
/// of curvature at the centre, convert degrees to metres. So the frame is affine, and an error bound on the grid holds
/// in the mesh. Lengths along the parallel and meridian of the centre are true; elsewhere east-west lengths are scaled
/// by cos φ_centre / cos φ. The cell is rounded so that float32 holds each sample's x and y exactly. With 5,000 samples
/// from the centre to the border, rounding changes the cell by less than 0.03 %. read_height_field() makes the same
/// frame from a file's CRS.
///
/// Frame::kind is kLocal, Frame::crs is empty, Frame::description states the centre and the cell. Fails with kUsage for
/// fewer than 1 column or row, an affine map that is not finite, a centre at or beyond a pole, and cells whose sides
/// are too unequal for float32. Cost: O(1).
Result<Frame> frame_of_degrees(const std::array<double, 6>& affine, int cols, int rows, const Geodetic& geodetic = {});

/// The position of a raster on the globe.
struct RasterPlace {
  /// Map from samples to x and y of the CRS, as Frame::affine.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  /// Map from longitude and latitude in degrees to x and y. Null: x and y are longitude and latitude.
  std::shared_ptr<const PointTransform> from_degrees = nullptr;
  /// The inverse map. Null if from_degrees is null. If only to_degrees is null, NodeSource::visit_samples() passes no
  /// samples.
  std::shared_ptr<const PointTransform> to_degrees = nullptr;
};

/// The place of a sample in its raster: column from the left, row from the top.
struct SampleAt {
  std::int32_t col = 0, row = 0;

  friend bool operator==(const SampleAt&, const SampleAt&) = default;
};

/// Borrowed additional values at the samples of the height grid, such as colours.
struct Channel {
  const float* samples = nullptr;  ///< cols·rows values; finite wherever the heights have a value
  double scale = 1;                ///< factor that makes the channel's errors comparable with errors in z units; at
                                   ///< least 0
};

/// Samples that are not an array of floats, such as 16-bit values in memory or a file larger than memory.
class SampleSource {
 public:
  virtual ~SampleSource() = default;
  /// Writes a window of cols × rows samples, the first at (col, row), to `out`: row-major, with `stride` floats from
  /// row to row. Nodata becomes NaN. Several threads may call it at once. Fails with kInput; the message names file and
  /// row. REQUIRES: the window lies in the raster.
  virtual Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const = 0;
  /// True if reading a window costs about as much as copying it. If false, callers read whole rows from the top down,
  /// once or a few times, and read small windows only where this is unavoidable.
  virtual bool is_in_memory() const = 0;
};

/// A source of 16-bit codes in memory, 2 bytes per sample. `codes` is row-major. Code k stands for heights[k], which is
/// NaN for nodata. REQUIRES: `cols` codes in each row, and a height for each code.
std::unique_ptr<SampleSource> make_coded_source(std::vector<std::uint16_t> codes, int cols, std::vector<float> heights);

/// A height field that borrows its samples.
///
/// Samples are row-major, with `cols` in each row and no padding. The first row is at the top (north) of the raster.
/// Sample (col, row) is the height at its pixel's centre. NaN, the infinities and samples equal to `nodata` are never
/// heights.
struct HeightField {
  const float* samples = nullptr;              ///< cols·rows values, owned and kept alive by the caller
  int cols = 0;                                ///< at least 2
  int rows = 0;                                ///< at least 2
  std::optional<float> nodata = std::nullopt;  ///< DEFAULT: none besides NaN and ±infinity
  Frame frame = {};  ///< position of the samples in the mesh. DEFAULT: cell size 1, first row at y = 0, y decreases
                     ///< from row to row
  /// Largest |given value − float32 sample| of data that does not fit float32 (int32, float64). Bounds are tightened by
  /// this much, so that they hold for the given values. DEFAULT: 0.
  double sample_rounding = 0;
  /// At most kMaxChannels channels. With channels, the error of a sample is the norm of (height_scale · |height error|,
  /// scale₁ · |error₁|, …). DEFAULT: none.
  std::vector<Channel> channels = {};
  double height_scale = 1;  ///< weight of the height error in this norm, at least 0. DEFAULT: 1.
  /// Borrowed source of the samples if `samples` is null. simplify() (without channels) and measure() accept a source;
  /// functions that need one array of samples fail with kUsage. DEFAULT: none.
  const SampleSource* source = nullptr;
};

inline constexpr int kMaxChannels = 64;

/// A height, and the number of samples with this height.
struct HeightCount {
  double height = 0;
  std::uint64_t samples = 0;
};

/// A height that is probably undeclared nodata: see find_undeclared_nodata().
struct UndeclaredNodata {
  HeightCount of;
  double value = 0;         ///< the corresponding value in the file
  bool is_high = false;     ///< true: above all real heights; false: below them
  double min = 0, max = 0;  ///< range of the real heights
};

/// Signs that heights packed into colours are wrong: the colours were changed after packing, or are not packed heights.
struct PackedDoubts {
  /// Number of suspect samples. The two neighbours of a suspect sample in its row have similar heights. They differ
  /// from the sample by 1/8 to 3/2 of a step of green or red, and this colour changes at the sample. 0 unless the
  /// differences are typical of interpolation or lossy compression. In a large raster, only some rows are searched for
  /// interpolation.
  std::uint64_t torn = 0;
  double torn_by = 0;      ///< largest of these differences
  std::string seems = {};  ///< another encoding with plausible heights, if most decoded heights are impossible on earth
};

/// Counts of missing samples, for ReadOptions::void_side.
struct VoidCount {
  std::uint64_t filled = 0;  ///< filled samples
  std::uint64_t left = 0;    ///< samples of larger voids and of voids at the raster's edge
  /// Each remaining void has a lowest and a highest neighbouring height. `least` is the maximum of all lowest heights;
  /// `most` is the minimum of all highest heights.
  double least = 0, most = 0;
};

/// Metadata of a raster that was read.
struct RasterInfo {
  std::string path;
  std::string format;       ///< "GTiff", "PGM", "STM", …
  std::string sample_type;  ///< type in the file: "Int16", "Float32", …
  std::string crs;          ///< CRS of the file, such as "EPSG:4326", or WKT without a known authority; empty if none
  std::string crs_unit;     ///< unit of the CRS's x and y: "metre", "US survey foot", "degree"; empty without a CRS
  double crs_unit_in_metres = 0;  ///< 0 for degrees, and if there is no CRS
  bool is_geographic = false;     ///< true if x and y of the file are degrees
  std::string vertical;           ///< vertical datum of the heights, if the CRS names it: "EGM96 height"; else empty
  bool is_ellipsoidal = false;    ///< true if the CRS declares ellipsoidal heights
  std::string crs_with_heights;   ///< WKT of the CRS if `vertical` is set; else empty
  std::string unit;               ///< unit of z if it is known; else empty
  double unit_in_metres = 1;      ///< length of the unit of z, known or assumed (HeightsIn); 0 if its name is unknown
  std::string file_unit;          ///< unit of the file's values, if known and different from `unit`; else empty
  bool unit_is_assumed = false;   ///< true if the unit of z, or of the values converted to metres, is not declared
  double scale = 1, offset = 0;   ///< declared by the file: value = scale · (stored value) + offset
  double z_scale = 1, z_offset = 0;  ///< height = z_scale · value + z_offset, from ReadOptions and the conversion to
                                     ///< metres
  std::optional<double> nodata;      ///< the effective nodata value, as a value of the file
  std::array<double, 6> geotransform{0, 1, 0, 0, 0, 1};  ///< GDAL's geotransform, of the pixel *corner*; identity if
                                                         ///< none
  bool has_georeference = false;
  double cell_x = 1, cell_y = 1;      ///< size of a cell in the units of the file's CRS
  double cell_x_m = 0, cell_y_m = 0;  ///< the same in metres at the centre; 0 if unknown
  bool has_range = true;              ///< false: the raster has not been read yet, so valid, min and max are unknown
  std::uint64_t valid = 0;            ///< samples that are heights
  double min = 0, max = 0;            ///< range of the valid samples
  std::vector<UndeclaredNodata> undeclared_nodata;  ///< set if has_range
  std::vector<std::string> warnings;                ///< sentences for the user: infinities read as nodata, …
  VoidCount voids = {};                             ///< set if has_range, or for samples in memory
  std::string view = {};       ///< description of the selection by ReadOptions::view; empty for one unchanged raster
  PackedDoubts packed = {};    ///< set for heights packed into colours
  std::string depths = {};     ///< reason why the values seem to be depths; empty if they do not, or were negated
  bool seems_degrees = false;  ///< true if x and y resemble degrees, but the CRS is not geographic
};

/// A height field that owns its samples, or their source. Nodata is NaN.
struct OwnedHeightField {
  std::vector<float> samples;  ///< empty if there is a `source`
  int cols = 0;
  int rows = 0;
  Frame frame;
  double sample_rounding = 0;
  RasterInfo info;
  std::shared_ptr<const SampleSource> source = nullptr;  ///< see open_height_field(). DEFAULT: none.
  /// Samples borrowed from the caller, used instead of `samples` and never changed. DEFAULT: none.
  const float* lent = nullptr;

  /// Borrows this object's samples: the view is valid while the object is alive and `samples` is not resized.
  HeightField view() const {
    const float* const held = lent != nullptr ? lent : samples.data();
    return {source ? nullptr : held, cols, rows, std::nullopt, frame, sample_rounding, {}, 1, source.get()};
  }
  /// Copies lent samples, so that they can be changed.
  void own() {
    if (lent == nullptr) return;
    samples.assign(lent, lent + static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
    lent = nullptr;
  }
  operator HeightField() const { return view(); }  // NOLINT: the function accepts both
};

/// Number, minimum and maximum of the samples that are heights. min = max = 0 if there are none, or if the samples are
/// not in memory. For a source, use Measurement::heights.
struct HeightRange {
  static constexpr std::size_t kEnds = 6;

  std::uint64_t valid = 0;
  double min = 0, max = 0;
  /// The lowest and the highest distinct heights, from the outermost inwards, with their numbers of samples; unused
  /// entries have 0 samples.
  std::array<HeightCount, kEnds> lowest{}, highest{};

  /// Adds the range of another part of the raster.
  void add(const HeightRange& part);
};
HeightRange height_range(const HeightField& field, int threads = 1);

/// Returns the lowest and highest heights that are probably undeclared nodata. `scale`, `offset`: height = scale ·
/// value + offset. Below, R is the range of all heights except those being judged, and d is the distance of a judged
/// height from this range. These values count as nodata:
/// - a usual sign for nodata (-999, -10000, -32768; ±9999, ±99999, ±999999, ±32767, ±65535; beyond ±1e20), if d >= 0.2
///   R;
/// - 0, if d >= 0.05 R, d >= 10, and at least a thousandth of the samples is 0 (land near a real sea at 0 is not much
///   higher);
/// - another whole number, such as -99, if d >= R, and a thousandth to half of the samples, and at least 10, have this
///   value;
/// - any other value, if d >= 50 R, and at most a hundredth of the samples has this value.
/// If R is 0, only the first rule applies. At most HeightRange::kEnds − 1 heights are found at each end. Cost: O(1).
std::vector<UndeclaredNodata> find_undeclared_nodata(const HeightRange& range, double scale = 1, double offset = 0);

/// The map from samples to the coordinates of lines. These are the coordinates of the raster's file or, if the file has
/// none, x = col, y = rows − 1 − row.
std::array<double, 6> map_affine(const RasterInfo& info, int rows);

/// Fills each nodata sample that has a valid sample within `max_distance` samples (Euclidean) in one of the eight
/// compass directions. Its height becomes the mean of the nearest valid samples in these directions, weighted by
/// inverse squared distance. Returns the number of samples filled. REQUIRES: max_distance > 0; the samples are in
/// memory (samples of a source do not change). Cost: O(cols·rows). Memory: 16 bytes per nodata sample.
std::uint64_t fill_nodata(OwnedHeightField& field, double max_distance);

/// Sets all nodata samples to the height `value`. Returns the number of samples filled. REQUIRES: the samples are in
/// memory.
std::uint64_t fill_background(OwnedHeightField& field, float value);

// Samples changed by lines.

/// A sample that a breakline changed.
struct SampleEdit {
  std::int32_t col = 0, row = 0;
  float before = 0, after = 0;
};

/// Returns `source` with Simplified::edits applied. The bound of a mesh with hard lines holds for the edited samples.
/// `edits`: edits of valid samples, in raster order. Cost of a window: that of `source`, plus one search for edits per
/// row.
std::shared_ptr<const SampleSource> edit_source(std::shared_ptr<const SampleSource> source,
                                                std::vector<SampleEdit> edits);

/// Applies the edits to `field`, in memory or by edit_source(). `edits`: as for edit_source(). Cost: O(edits).
void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field);

// Types for scattered samples.

/// A line through points of a set: a contour, a ridge, the foot of a dam.
struct PointLine {
  std::vector<std::uint32_t> points;  ///< at least two; successive indices differ; a ring ends with its first index
  std::string name;                   ///< for messages: "contours.gpkg feature 12"
  bool keeps_vertices = false;        ///< true: all points become vertices, as for breaklines; false: only the
                                      ///< necessary points
};

/// The points of an ASPRS class; class 2 is ground.
struct PointClass {
  int number = 0;
  std::uint64_t points = 0;
};

/// Facts about a LAS or LAZ file, and the numbers of its points that were not read, by reason. Each point counts once,
/// for the first reason that applies, in the order of the members.
struct LasFacts {
  std::string version;              ///< "1.4"
  int point_format = 0;             ///< 0 to 10
  std::uint64_t points = 0;         ///< number in the file
  std::vector<PointClass> classes;  ///< counts of points that are not withheld, read or not; sorted by number
  std::uint64_t withheld = 0, of_other_classes = 0, overlap = 0, of_other_returns = 0;
};

/// Scattered samples: heights z at (x, y) in one plane coordinate system, x east, y north.
struct PointSet {
  std::vector<double> x, y, z;   ///< coordinates, of equal size; all finite
  std::vector<PointLine> lines;  ///< lines that no triangle crosses. EMPTY: none
  /// Rings of polygons at which the surface ends, as indices of their corners; holes are also rings. All points lie
  /// inside, by the even-odd rule. Made by cut_to_boundary(). EMPTY: the surface ends at a hull.
  std::vector<std::vector<std::uint32_t>> boundary;
  /// Error bounds of the first points, for PointOptions::tolerances; the other points have none. Functions that omit or
  /// sort points keep each bound with its point. EMPTY: none.
  std::vector<float> tolerances;
  /// Names, as in read_lines(), of boundaries in the file at which the surface does not end: "survey.xml:EG".
  std::vector<std::string> outlines;
  std::string path;         ///< source of the points, for messages
  std::string format;       ///< "CSV", "GPKG", …
  std::string crs;          ///< CRS of x and y: "EPSG:32611", WKT, or empty
  std::string description;  ///< one line for reports: the meaning and unit of x and y
  bool is_local = false;    ///< x and y are metres from the middle of the points
  std::string source_crs;   ///< CRS of the file, if is_local; else empty
  /// The affine map from x and y to the coordinates of the file, like RasterInfo::geotransform: the identity unless
  /// is_local.
  std::array<double, 6> to_source{0, 1, 0, 0, 0, 1};
  double unit_in_metres = 0;  ///< unit of x and y; 0 for degrees and unknown units
  /// Metadata of z, as for a raster's heights: unit, unit_in_metres, unit_is_assumed, file_unit, z_scale, z_offset; and
  /// crs_unit, crs_unit_in_metres of x and y in the file.
  RasterInfo heights = {};
  std::vector<std::string> warnings;
  std::string columns;               ///< one line for reports: the use of each column, or the origin of the heights
  std::uint64_t without_height = 0;  ///< points omitted by ReadPointsOptions::nodata
  std::uint64_t spikes = 0;          ///< points omitted by drop_spikes()
  std::uint64_t outside = 0;         ///< points omitted by ReadPointsOptions::extent
  std::uint64_t added = 0;           ///< last points, which cut_to_boundary() added; errors do not count them
  bool is_geographic = false;        ///< true if x and y of lent points are degrees, without a CRS known to GDAL
  std::optional<LasFacts> las = {};  ///< facts about a LAS or LAZ file

  std::size_t size() const { return x.size(); }
  /// The position of a point in the coordinates of the file, up to rounding.
  std::array<double, 2> place_in_file(std::size_t i) const {
    return {to_source[0] + to_source[1] * x[i], to_source[3] + to_source[5] * y[i]};
  }
};

/// Rule for several points with the same given x and y.
enum class DuplicatePolicy { kFirst, kLast, kHighest, kLowest, kMean };

/// The fit of the convex hull to points.
struct HullFit {
  double bridged = 0;          ///< share of the hull's area in bays without points
  std::uint64_t slivers = 0;   ///< long steep triangles along the hull, where the points' outline is nearly straight
  double boundary_length = 0;  ///< PointOptions::boundary_length for a mesh that ends at the points; 0: the hull fits
};

}  // namespace scarp

#pragma GCC visibility pop
