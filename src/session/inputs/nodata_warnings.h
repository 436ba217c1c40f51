// Heights that were probably meant as nodata.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::cli {

/// A warning for each height that most likely stands for nodata, with the option that declares it. If another nodata
/// value is in use, the warning has a command that merges both values. `info` describes `field`.
std::vector<std::string> warn_of_undeclared_nodata(const RasterInfo& info, const HeightField& field);

}  // namespace scarp::cli
