// Options by name: the words of a command line, read by the program's own table and parsers.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scarp/result.h"
#include "scarp_c.h"
#include "session/table/option_table.h"

struct scarp_settings {
  /// Names as the program has them ("--max-error"), in the order in which they were set.
  std::vector<std::pair<std::string, std::string>> values;
};

namespace scarp::door {

/// "max_error", "max-error" and "--max-error" are one: the name in the program's table.
std::string name_in_program(const std::string& name);

/// An option of a call.
bool has_setting(const scarp_options& asked, const char* name);

/// The words of a command line: `arguments`, which are the command's name, its inputs and its outputs, and the options:
/// those `beside` the caller's, the struct's members where no option by name goes before them, then those by name.
/// kUsage, in one sentence.
Result<std::vector<std::string>> words_of(cli::Commands command, const std::vector<std::string>& arguments,
                                          const scarp_options& asked, const std::vector<std::string>& beside = {});

/// Has `program`, to which the command was added, parse them. kUsage, in one sentence.
Result<void> parse_words(CLI::App& program, std::vector<std::string> words);

/// Both.
Result<void> parse_options(CLI::App& program, cli::Commands command, const std::vector<std::string>& arguments,
                           const scarp_options& asked, const std::vector<std::string>& beside = {});

}  // namespace scarp::door
