// Lines and the boundary that vector files add to scattered points.
#pragma once

#include <optional>
#include <vector>

#include "scarp/lines.h"
#include "scarp/points.h"
#include "scarp/run.h"
#include "session/options/points_options.h"

namespace scarp::cli {

/// Reads the files of --breaklines, in the CRS and the unit of the points, and adds their lines. A vertex outside the
/// points that needs a height causes a warning.
Result<void> add_breaklines(const GivenOptions& given, DuplicatePolicy duplicates, const ProgressCallback& progress,
                            PointSet& points);

/// Makes lakes of the united polygons of --water. Lakes outside the points cause a warning.
Result<std::vector<PointLake>> add_lakes(const GivenOptions& given, DuplicatePolicy duplicates,
                                         const ProgressCallback& progress, PointSet& points);
/// Drops the points in the lakes of --water, and all lines, before a mesh with lakes is judged.
Result<void> drop_lakes(const GivenOptions& given, const ProgressCallback& progress, PointSet& points);

/// Clips the points to the polygons of --boundary, if it names a file. `tolerance`: of the surface along the polygons.
/// `called`: the option in messages.
Result<std::optional<BoundaryCut>> cut_to_boundary(const GivenOptions& given, OptionId called,
                                                   DuplicatePolicy duplicates, double tolerance,
                                                   const ProgressCallback& progress, PointSet& points);

/// The points' tolerances: the smaller of --tolerance and --roi, or `beyond` elsewhere; empty without these options. A
/// file that lowers no tolerance causes a warning.
Result<std::vector<float>> read_tolerances(const GivenOptions& given, double beyond, const ProgressCallback& progress,
                                           PointSet& points);

/// The united polygons of --boundary; empty if it names no file.
Result<std::vector<Line>> read_boundary(const GivenOptions& given, OptionId called, const ProgressCallback& progress,
                                        PointSet& points);

}  // namespace scarp::cli
