// The command that argv names, and an option without its value, directly before another option.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace scarp::cli {

/// The command with that name; nullptr if there is none.
const CLI::App* find_command(const CLI::App& program, std::string_view name);

/// The complaint about the first word that reads as an option where the value of the one before it belongs, as in
/// "--report --overwrite", which CLI11 would read as a value. A value that reads like an option is given as
/// "--report=--overwrite". Nothing if there is none. Examines the options of the command that argv names.
std::optional<std::string> find_missing_value(const CLI::App& program, int argc, const char* const* argv);

}  // namespace scarp::cli
