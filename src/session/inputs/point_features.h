// Lines and the boundary that vector files add to scattered points.
#pragma once

#include <optional>
#include <vector>

#include "scarp/lines.h"
#include "scarp/points.h"
#include "scarp/run.h"
#include "session/options/points_options.h"

namespace scarp::cli {

/// Reads the files of --breaklines, in the CRS and the unit of the points, and adds their lines. A vertex beyond the
/// points that needs a height causes a warning.
Result<void> add_breaklines(const GivenOptions& given, DuplicatePolicy duplicates, const ProgressCallback& progress,
                            PointSet& points);

/// Makes lakes of the polygons of --water, united. Lakes beyond the points cause a warning.
Result<std::vector<PointLake>> add_lakes(const GivenOptions& given, DuplicatePolicy duplicates,
                                         const ProgressCallback& progress, PointSet& points);
/// Drops the points in the lakes of --water, and all lines, for the judge of such a mesh.
Result<void> drop_lakes(const GivenOptions& given, const ProgressCallback& progress, PointSet& points);

/// Ends the points at the polygons of --boundary, if that names a file. `tolerance`: of the surface along them.
/// `called`: the option in messages.
Result<std::optional<BoundaryCut>> cut_to_boundary(const GivenOptions& given, OptionId called,
                                                   DuplicatePolicy duplicates, double tolerance,
                                                   const ProgressCallback& progress, PointSet& points);

/// The points' tolerances by --tolerance and --roi, the smaller one of both, with `beyond` elsewhere; empty without
/// them. A file that lowers none causes a warning.
Result<std::vector<float>> read_tolerances(const GivenOptions& given, double beyond, const ProgressCallback& progress,
                                           PointSet& points);

/// The polygons of --boundary, united; empty if it names no file.
Result<std::vector<Line>> read_boundary(const GivenOptions& given, OptionId called, const ProgressCallback& progress,
                                        PointSet& points);

}  // namespace scarp::cli
