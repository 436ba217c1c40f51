// The readers behind what is lent.
#pragma once

#include <array>
#include <string>

#include "io/lend.h"
#include "io/raster/height_unit.h"
#include "scarp/io.h"

namespace scarp {

/// Null where this thread has lent nothing of that kind under the name.
const LentRaster* find_lent_raster(const std::string& name);
const Mesh* find_lent_mesh(const std::string& name);
const PointSet* find_lent_points(const std::string& name);

/// read_height_field() of a raster that is lent.
Result<OwnedHeightField> read_lent_raster(const LentRaster& raster, const std::string& name,
                                          const ReadOptions& options);

/// read_points() of points that are lent.
Result<PointSet> read_lent_points(const PointSet& lent, const std::string& name, const ReadPointsOptions& options);

/// Completes the facts in `info` about the position of a raster with a geotransform, and finds the frame that the
/// options ask for. A build without GDAL knows no CRS: it refuses those that the options name.
Result<Frame> place_lent_raster(const LentRaster& raster, const ReadOptions& options, RasterInfo& info);
/// The same for points in memory: converts their x and y as the options ask. Returns the unit of their vertical CRS.
Result<HeightUnit> place_lent_points(const ReadPointsOptions& options, PointSet& points);

}  // namespace scarp
