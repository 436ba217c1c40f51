// A caller's arrays in memory, to be read by name as if they were a file.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "scarp/mesh.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Samples in memory and their position: the content of a raster file.
struct LentRaster {
  const float* samples = nullptr;              ///< cols·rows values, row-major, the first row at the top; borrowed
  int cols = 0, rows = 0;                      ///< at least 2
  std::optional<float> nodata = std::nullopt;  ///< DEFAULT: none besides NaN and ±infinity
  /// GDAL's, of pixel corners; the sample (col, row) is its pixel's centre. DEFAULT: no georeference.
  std::optional<std::array<double, 6>> geotransform = std::nullopt;
  /// CRS of the geotransform: "EPSG:32611", WKT, a PROJ string. A build without GDAL knows no CRS and uses this as a
  /// name. DEFAULT: none.
  std::string crs = {};
  bool is_geographic = false;  ///< without a CRS that GDAL knows: x and y are degrees on WGS 84. DEFAULT: false.
  double sample_rounding = 0;  ///< like HeightField::sample_rounding. DEFAULT: 0.
  std::string unit = {};       ///< unit of the samples, like RasterInfo::unit. DEFAULT: it is not known.
};

/// While it lives, `name` is the name of the thing for every reader that this thread calls: read_height_field() and
/// open_height_field(), read_mesh(), read_points(). It goes before files of that name. The object lent last counts. The
/// thing is borrowed, and so are its samples: a field that is read holds them as OwnedHeightField::lent, uncopied, but
/// where one of them is `nodata` or infinite, or where heights are scaled. Must end in the thread that began it, in
/// reverse order of beginning.
class Lent {
 public:
  Lent(std::string name, const LentRaster& raster);
  Lent(std::string name, const Mesh& mesh);
  Lent(std::string name, const PointSet& points);
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
  ~Lent();
};

}  // namespace scarp

#pragma GCC visibility pop
