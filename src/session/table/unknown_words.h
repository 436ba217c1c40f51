// Words that Scarp does not know, and the ones that were probably meant: misspelled, or another program's.
#pragma once

#include <optional>
#include <string>

#include "scarp/result.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The sentence about a word that is no option of the command (null: of none was chosen), with the option that was
/// probably meant.
std::string describe_unknown_option(const CLI::App* command, const std::string& word);
/// The complaint about the first word that is an option of another program, such as -te of GDAL, or a long option
/// behind a single dash. CLI11 would read it as a short option with its value. Examines the command that argv names.
std::optional<std::string> find_foreign_option(const CLI::App& program, int argc, const char* const* argv);
/// The error for a word that is no command's name, with the command that was probably meant.
Error unknown_command(const std::string& word);

}  // namespace scarp::cli
