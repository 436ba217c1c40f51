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
#include <string>
#include <vector>

#include "scarp/frame.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

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

}  // namespace scarp

#pragma GCC visibility pop
