// Objects in memory that readers access by name like files.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "scarp/mesh.h"

#pragma GCC visibility push(default)

namespace scarp::io {

/// Samples in memory and their position, equivalent to a raster file.
struct LentRaster {
  const float* samples = nullptr;              ///< cols·rows values, row-major, top row first; borrowed
  int cols = 0, rows = 0;                      ///< at least 2
  std::optional<float> nodata = std::nullopt;  ///< DEFAULT: only NaN and ±infinity
  /// GDAL's geotransform, for pixel corners; each sample is at its pixel's centre. DEFAULT: no georeference.
  std::optional<std::array<double, 6>> geotransform = std::nullopt;
  /// CRS of the geotransform: "EPSG:32611", WKT, a PROJ string. A build without GDAL uses it only as a name. DEFAULT:
  /// none.
  std::string crs = {};
  bool is_geographic = false;  ///< for a CRS that GDAL does not know: x and y are degrees on WGS 84. DEFAULT: false.
  double sample_rounding = 0;  ///< like HeightField::sample_rounding. DEFAULT: 0.
  std::string unit = {};       ///< unit of the samples, like RasterInfo::unit. DEFAULT: unknown.
};

/// While it lives, `name` stands for the object in every reader that this thread calls: read_height_field() and
/// open_height_field(), read_mesh(), read_points(). It has precedence over files of that name. The latest of several
/// objects has precedence over earlier ones. The object and its samples are borrowed. A field that is read refers to
/// these samples as OwnedHeightField::lent. The field copies them only if a sample is `nodata` or infinite, or heights
/// are scaled. Must end in the thread that began it, in reverse order of creation.
class Lent {
 public:
  Lent(std::string name, const LentRaster& raster);
  Lent(std::string name, const Mesh& mesh);
  Lent(std::string name, const PointSet& points);
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
  ~Lent();
};

}  // namespace scarp::io

#pragma GCC visibility pop
