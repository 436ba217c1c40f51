// Options by name, converted to command-line words for the program's own table and parsers.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scarp/result.h"
#include "scarp_c.h"
#include "session/table/option_table.h"

struct scarp_settings {
  /// Names as in the program ("--max-error"), in the order set.
  std::vector<std::pair<std::string, std::string>> values;
};

namespace scarp::door {

/// The name in the program's table for "max_error", "max-error" or "--max-error".
std::string name_in_program(const std::string& name);

/// True if the call sets the option.
bool has_setting(const scarp_options& asked, const char* name);

/// The command-line words for `arguments` (the command's name, inputs and outputs) and these options: those in
/// `beside`, struct members that no option by name overrides, and options by name. Fails with kUsage, in one sentence.
Result<std::vector<std::string>> words_of(cli::Commands command, const std::vector<std::string>& arguments,
                                          const scarp_options& asked, const std::vector<std::string>& beside = {});

/// Parses the words with `program`, to which the command was added. Fails with kUsage, in one sentence.
Result<void> parse_words(CLI::App& program, std::vector<std::string> words);

Result<void> parse_options(CLI::App& program, cli::Commands command, const std::vector<std::string>& arguments,
                           const scarp_options& asked, const std::vector<std::string>& beside = {});

}  // namespace scarp::door
