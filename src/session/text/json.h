// The type of reports, forward-declared; json_text.h creates reports.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace scarp::cli {

using Json = nlohmann::ordered_json;

}  // namespace scarp::cli
