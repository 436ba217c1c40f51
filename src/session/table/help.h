// The text of `--help` and `scarp help`, made from the table of options.
#pragma once

#include <string>

#include "scarp/result.h"
#include "session/table/option_table.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The program's help: its commands, and three to begin with.
std::string program_help();
/// A command's help. No line is longer than 100 characters. Unless `all` options are asked for, those of a command that
/// would not fit a screen are the most used ones, one line each.
std::string command_help(const CommandRow& command, bool all);
/// The tables of options (of one command, or of all: null) and of mesh formats as JSON. Keys keep their names.
std::string help_json(const CommandRow* command);
/// "choose simplify, measure or info", of all commands.
std::string choose_command();
/// Throws std::logic_error if the table has an option that the program does not accept.
void check_table(const CLI::App& program);

}  // namespace scarp::cli
