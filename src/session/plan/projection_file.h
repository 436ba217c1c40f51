// The .prj file next to a mesh on a map: the CRS, for the formats that have no place for it.
#pragma once

#include <string>
#include <vector>

#include "session/plan/simplify_plan.h"

namespace scarp::cli {

struct ProjectionFile {
  std::string path;  ///< the mesh's, but for the extension
  std::string text;
};

/// For the mesh, or each level, whose x and y are in `crs`. Empty where none is needed: the format or the mesh has no
/// CRS, or the file holds it already. Fails with kOutput where it would replace what it may not: any file without
/// --overwrite, and with it one that belongs to other files of its name.
Result<std::vector<ProjectionFile>> plan_projection_files(const SimplifyPlan& plan, const std::string& crs);

}  // namespace scarp::cli
