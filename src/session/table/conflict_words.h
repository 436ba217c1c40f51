// The library's table of conflicts in terms of options: as JSON and for the page of conflicts.
#pragma once

#include <nlohmann/json.hpp>

namespace scarp::cli {

/// A list of rows: `setting`, `with`, `beside` (another setting, or empty), `because`, and `tiles`, true for settings
/// of tiles.
nlohmann::ordered_json describe_conflicts();

}  // namespace scarp::cli
