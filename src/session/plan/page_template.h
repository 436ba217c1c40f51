// What the viewer's page is made from.
#pragma once

#include <string>
#include <string_view>

#include "scarp/result.h"

namespace scarp::cli {

/// Where it takes a mesh and the raster.
inline constexpr std::string_view kPlaceOfData = "<!--SCARP-DATA-->";

/// The page that `make viewer` builds: share/scarp/viewer.html beside the program's folder. Fails
/// with kInput where it is not there.
Result<std::string> read_page_template();

}  // namespace scarp::cli
