// The unit of heights of points, determined as for a raster; frames and cropping of points.
#pragma once

#include <array>
#include <string>

#include "io/raster/height_unit.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::io {

/// True if x and y become metres around their middle because of ReadPointsOptions::default_frame, without a request by
/// `crs`.
bool becomes_local(const ReadPointsOptions& options, double unit_in_metres);

/// The middle of the extent. REQUIRES: at least one point.
std::array<double, 2> middle_of(const PointSet& points);

/// Moves the middle of x and y to the origin and converts both to metres. `whose`: names the old coordinates in the
/// description.
void make_local_metres(const std::array<double, 2>& metres, const std::string& whose, PointSet& points);

/// Removes points with the height `nodata` or a height that is not finite. Fails if no points remain.
Result<void> leave_out_nodata(double nodata, PointSet& points);
/// Removes and counts the points outside ReadPointsOptions::extent. REQUIRES: x and y as in the file.
Result<void> crop(const ReadPointsOptions& options, PointSet& points);
tl::unexpected<Error> refuse_empty_extent(const PointSet& points);
tl::unexpected<Error> refuse_no_heights(const PointSet& points);

/// The command that adds a CRS to the file of the points.
std::string crs_command(const PointSet& points, const std::string& crs);

/// Places x and y without a CRS: unchanged, or in metres around their middle if their unit is known. Rejects other
/// frames.
Result<void> place_without_crs(const ReadPointsOptions& options, PointSet& points);

/// Scales the heights as the options request, and to metres if the frame or the output file is in metres. On input,
/// points.heights holds the unit in a column's or attribute's name, and its crs_unit is the unit of x and y. The rest
/// is set here. `vertical`: the unit of the vertical CRS. REQUIRES: x and y are in their frame.
Result<void> settle_point_heights(const ReadPointsOptions& options, const HeightUnit& vertical, PointSet& points);

}  // namespace scarp::io
