// Heights that were meant to be nodata.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::cli {

/// A sentence for each height that most likely stands for nodata, with the option to give, or, where another nodata
/// value counts already, the command that makes one of both. `field` is the field that the info describes.
std::vector<std::string> warn_of_undeclared_nodata(const RasterInfo& info, const HeightField& field);

}  // namespace scarp::cli
