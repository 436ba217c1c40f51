// The library's table of conflicts in the words of options, for programs and the page that is made of it.
#pragma once

#include <nlohmann/json.hpp>

namespace scarp::cli {

/// A list of rows: `setting`, `with`, `beside` (also set, or empty), `because`, and `tiles`, true for settings of tiles.
nlohmann::ordered_json describe_conflicts();

}  // namespace scarp::cli
