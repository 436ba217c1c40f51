// The template of the viewer's page.
#pragma once

#include <string>
#include <string_view>

#include "scarp/result.h"

namespace scarp::cli {

/// The place in the template for a mesh and the raster.
inline constexpr std::string_view kPlaceOfData = "<!--SCARP-DATA-->";

/// The page that `make viewer` builds: share/scarp/viewer.html next to the program's folder. Fails with kInput if it is
/// missing.
Result<std::string> read_page_template();

}  // namespace scarp::cli
