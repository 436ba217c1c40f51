// The unit of heights of points: decided as that of a raster.
#pragma once

#include <array>
#include <string>

#include "io/raster/height_unit.h"
#include "scarp/points.h"

namespace scarp {

/// True where x and y become metres around their middle though `crs` does not say so: ReadPointsOptions::default_frame.
bool becomes_local(const ReadPointsOptions& options, double unit_in_metres);

/// Of the extent. REQUIRES: some points.
std::array<double, 2> middle_of(const PointSet& points);

/// Moves the middle of x and y to the origin and makes metres of both. `whose`: their coordinates, for the description.
void make_local_metres(const std::array<double, 2>& metres, const std::string& whose, PointSet& points);

/// Scales the heights as the options say, and to metres where the frame or the file to write is in metres.
/// points.heights.unit is what the name of a column or an attribute says, crs_unit that of x and y; the rest is filled
/// in. `vertical`: the unit of the vertical CRS. REQUIRES: x and y are in their frame.
Result<void> settle_point_heights(const ReadPointsOptions& options, const HeightUnit& vertical, PointSet& points);

}  // namespace scarp
