// The readers for lent objects.
#pragma once

#include <array>
#include <string>

#include "io/lend.h"
#include "io/raster/height_unit.h"
#include "scarp/io.h"

namespace scarp::io {

/// Null if this thread has lent no raster under the name.
const LentRaster* find_lent_raster(const std::string& name);
const Mesh* find_lent_mesh(const std::string& name);
const PointSet* find_lent_points(const std::string& name);

/// read_height_field() for a lent raster.
Result<OwnedHeightField> read_lent_raster(const LentRaster& raster, const std::string& name,
                                          const ReadOptions& options);

/// read_points() for lent points.
Result<PointSet> read_lent_points(const PointSet& lent, const std::string& name, const ReadPointsOptions& options);

/// Completes the position in `info` if the raster has a geotransform. Returns the frame requested by the options. A
/// build without GDAL knows no CRS and rejects the options' CRS.
Result<Frame> place_lent_raster(const LentRaster& raster, const ReadOptions& options, RasterInfo& info);
/// Converts x and y of points in memory as requested by the options. Returns the unit of their vertical CRS.
Result<HeightUnit> place_lent_points(const ReadPointsOptions& options, PointSet& points);

}  // namespace scarp::io
