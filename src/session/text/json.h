// The type of reports, for those who hand them on; json_text.h for those who make them.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace scarp::cli {

using Json = nlohmann::ordered_json;

}  // namespace scarp::cli
