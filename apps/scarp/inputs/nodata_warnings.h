// Heights that were meant to be nodata.
#pragma once

#include <string>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::cli {

/// A sentence for each height that most likely stands for nodata, with the option to give.
std::vector<std::string> warn_of_undeclared_nodata(const RasterInfo& info);

}  // namespace scarp::cli
