// The unit of heights of points: decided as that of a raster.
#pragma once

#include <array>
#include <string>

#include "io/raster/height_unit.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp {

/// True where x and y become metres around their middle though `crs` does not ask for it:
/// ReadPointsOptions::default_frame.
bool becomes_local(const ReadPointsOptions& options, double unit_in_metres);

/// The middle of the extent. REQUIRES: some points.
std::array<double, 2> middle_of(const PointSet& points);

/// Moves the middle of x and y to the origin and makes metres of both. `whose`: their coordinates, for the description.
void make_local_metres(const std::array<double, 2>& metres, const std::string& whose, PointSet& points);

/// Removes points of that height, and those whose height is not finite. Fails if none is left.
Result<void> leave_out_nodata(double nodata, PointSet& points);
/// Omits and counts the points outside ReadPointsOptions::extent. REQUIRES: x and y as in the file.
Result<void> crop(const ReadPointsOptions& options, PointSet& points);
tl::unexpected<Error> refuse_empty_extent(const PointSet& points);

/// The command that gives the file of the points a CRS.
std::string crs_command(const PointSet& points, const std::string& crs);

/// Places x and y that have no CRS: as they are, or in metres around their middle if their unit is known. Refuses
/// another frame.
Result<void> place_without_crs(const ReadPointsOptions& options, PointSet& points);

/// Scales the heights as the options ask, and to metres where the frame or the file to write is in metres.
/// points.heights.unit is the one in the name of a column or an attribute, crs_unit that of x and y; the rest is filled
/// in. `vertical`: the unit of the vertical CRS. REQUIRES: x and y are in their frame.
Result<void> settle_point_heights(const ReadPointsOptions& options, const HeightUnit& vertical, PointSet& points);

}  // namespace scarp
