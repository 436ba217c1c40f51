// The map from the samples of a height field to the coordinates of its mesh.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#pragma GCC visibility push(default)

namespace scarp {

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

}  // namespace scarp

#pragma GCC visibility pop
