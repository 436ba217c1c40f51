// The rows of the table of options by subject; callers use option_table.h.
#pragma once

#include <span>

#include "session/table/option_table.h"

namespace scarp::cli {

std::span<const OptionRow> goal_rows();
std::span<const OptionRow> file_rows();
std::span<const OptionRow> sample_rows();
std::span<const OptionRow> line_rows();
std::span<const OptionRow> strategy_rows();
std::span<const OptionRow> tile_rows();
std::span<const OptionRow> run_rows();

}  // namespace scarp::cli
