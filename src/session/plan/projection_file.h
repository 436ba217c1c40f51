// The .prj file next to a georeferenced mesh, for formats that cannot hold a CRS.
#pragma once

#include <string>
#include <vector>

#include "session/plan/simplify_plan.h"

namespace scarp::cli {

struct ProjectionFile {
  std::string path;  ///< the mesh's, with another extension
  std::string text;
};

/// Files for the mesh, or each level, with x and y in `crs`. Empty if none is needed: the format or the mesh has no
/// CRS, or the mesh file holds it. Fails with kOutput for an existing file, unless --overwrite is given and the file
/// belongs to no other files of that name.
Result<std::vector<ProjectionFile>> plan_projection_files(const SimplifyPlan& plan, const std::string& crs);

}  // namespace scarp::cli
