// Making a print of a terrain, and telling of it.
#pragma once

#include <string>
#include <vector>

#include "scarp/print.h"
#include "session/text/json.h"

namespace scarp::cli {

/// simplify_for_print(), with the names of options in its complaints.
Result<PrintedTerrain> simplify_as_print(const PrintOptions& plan, OwnedHeightField& field,
                                         const SimplifyOptions& options);

/// The "solid" object of the report; `paths` has the file of each print tile, or one for all.
Json describe_print(const PrintOptions& plan, const Print& print, const std::vector<std::string>& paths);
/// Its part of the summary.
std::string print_lines(const PrintOptions& plan, const Print& print);

}  // namespace scarp::cli
