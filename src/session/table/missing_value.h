// Finds the command in argv, and an option that is followed by another option instead of its value.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace scarp::cli {

/// The command with that name; nullptr if none.
const CLI::App* find_command(const CLI::App& program, std::string_view name);

/// Reports the first option-like word where a value is expected, as in "--report --overwrite". CLI11 would read it as a
/// value. Such a value needs "=": "--report=--overwrite". Nothing if there is no such word. Checks the options of the
/// command in argv.
std::optional<std::string> find_missing_value(const CLI::App& program, int argc, const char* const* argv);

}  // namespace scarp::cli
