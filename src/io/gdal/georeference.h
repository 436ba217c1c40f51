// Conversion of a raster's geotransform and CRS to the frame of its mesh.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::gdal {

struct Georeference {
  int cols = 0, rows = 0;
  bool located = false;                             ///< true if the raster has a geotransform
  std::array<double, 6> pixels{0, 1, 0, 0, 0, 1};   ///< GDAL's geotransform, of pixel corners
  std::array<double, 6> samples{0, 1, 0, 0, 0, 1};  ///< map as in a Frame: integer (col, row) are pixel centres
  Crs crs;                                          ///< null if unknown
  SpaceCrs in_space;                                ///< the CRS with heights; null if unknown
  bool geographic = false;
  double unit_in_metres = 1;  ///< unit of x and y, in metres; if geographic, in radians
  std::string unit_name;      ///< "metre", "degree", …; empty without a CRS

  /// Position of the sample (cols / 2, rows / 2).
  std::array<double, 2> centre() const;
  /// Metres per unit of x and y; 0 for degrees, and without a CRS.
  double length_in_metres() const;
};

/// `space`: the CRS with heights, if known.
Georeference make_georeference(int cols, int rows, const std::optional<std::array<double, 6>>& pixels, Crs crs,
                               SpaceCrs space);

/// Fails with kInput if the geotransform is not finite or maps all samples to a line.
Result<Georeference> read_georeference(GDALDatasetH dataset, const std::string& path);

/// Sets the CRS, cell sizes and warnings of `info`.
void describe_georeference(const Georeference& georeference, RasterInfo& info);

/// The frame requested by the options. Adds warnings to `info`. Fails with kUsage if the CRS is unknown or the
/// conversion fails for a part of the raster.
Result<Frame> choose_frame(const Georeference& georeference, const ReadOptions& options, RasterInfo& info);

}  // namespace scarp::gdal
