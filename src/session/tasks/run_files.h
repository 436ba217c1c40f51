// Files of a run, besides OUTPUT, that need only its meshes, of a raster or of points.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/picture.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

Result<void> add_picture(const std::string& path, const Picture& picture, std::vector<ReadyFile>& files);

/// --contours-out: a FeatureCollection like GDAL's. It names the CRS unless the mesh has its own frame.
Result<void> add_contours(const SimplifyPlan& plan, const SimplifyRun& run, const std::string& crs,
                          std::vector<ReadyFile>& files);

/// The files after OUTPUT: all levels of --lods, which replace it, the page of --html, and projections. `encode`
/// encodes the run's mesh as OUTPUT. `field`: judges the meshes on the page; may be null.
Result<void> finish_files(const SimplifyPlan& plan, const std::function<Result<void>(ReadyFile& file)>& encode,
                          const OwnedHeightField* field, SimplifyRun& run, std::vector<ReadyFile>& files);

}  // namespace scarp::cli
