// Unknown words, misspelled or from another program, and the words probably meant.
#pragma once

#include <optional>
#include <string>

#include "scarp/result.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The error for an unknown option of the command (null: none was chosen), with the option probably meant.
std::string describe_unknown_option(const CLI::App* command, const std::string& word);
/// Reports the first option of another program, such as -te of GDAL, or the first long option after a single dash.
/// CLI11 would read it as a short option with its value. Checks the options of the command in argv.
std::optional<std::string> find_foreign_option(const CLI::App& program, int argc, const char* const* argv);
/// The error for an unknown command, with the command probably meant.
Error unknown_command(const std::string& word);

}  // namespace scarp::cli
