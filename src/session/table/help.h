// The text of `--help` and `scarp help`, made from the table of options.
#pragma once

#include <string>

#include "scarp/result.h"
#include "session/table/option_table.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The program's help: its commands, and three to try.
std::string program_help();
/// A command's help, with lines of at most 100 characters. If the options do not fit a screen and `all` is false, only
/// the most used ones are listed, one line each.
std::string command_help(const CommandRow& command, bool all);
/// The tables of options (of one command; null: all) and mesh formats as JSON. Keys are stable.
std::string help_json(const CommandRow* command);
/// "choose simplify, measure or info": lists all commands.
std::string choose_command();
/// Throws std::logic_error if the program rejects an option of the table.
void check_table(const CLI::App& program);

}  // namespace scarp::cli
