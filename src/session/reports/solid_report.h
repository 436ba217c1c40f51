// The print of a terrain in the report and the summary.
#pragma once

#include <string>
#include <vector>

#include "scarp/print.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The "solid" object of the report. `paths`: one file for each print tile, or one for all.
Json describe_print(const PrintOptions& plan, const Print& print, const std::vector<std::string>& paths);
/// Lines of the summary.
std::string print_lines(const PrintOptions& plan, const Print& print);

}  // namespace scarp::cli
