// Files of a run besides OUTPUT that need only its meshes, whether they are of a raster or of points.
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

/// --contours-out: a FeatureCollection like GDAL's. It names the CRS unless the mesh is in a frame of its own.
Result<void> add_contours(const SimplifyPlan& plan, const SimplifyRun& run, const std::string& crs,
                          std::vector<ReadyFile>& files);

/// --html: shows the GLB files of this run, or the mesh as one. `field`: judges the meshes; may be null.
Result<void> add_page(const SimplifyPlan& plan, const OwnedHeightField* field, SimplifyRun& run,
                      std::vector<ReadyFile>& files);

/// --lods: replaces OUTPUT, the finest level, by all levels: separate files or one. `encode` encodes the run's mesh.
Result<void> encode_levels(const SimplifyPlan& plan, const std::function<Result<void>(ReadyFile& file)>& encode,
                           SimplifyRun& run, std::vector<ReadyFile>& files);

}  // namespace scarp::cli
