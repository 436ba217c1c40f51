#include "session/table/missing_value.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <string_view>

namespace scarp::cli {
namespace {

/// The option with this name, or null.
const CLI::Option* find_option(const CLI::App& command, const std::string& word) {
  return word.rfind('-', 0) == 0 ? command.get_option_no_throw(word) : nullptr;
}

/// True for a command's options and for words that begin like a long option, but not for a value such as -5.
bool reads_as_option(const CLI::App& command, const std::string& word) {
  const bool is_long = word.size() > 2 && word.rfind("--", 0) == 0 && std::isalpha(static_cast<unsigned char>(word[2]));
  return is_long || find_option(command, word) != nullptr;
}

}  // namespace

const CLI::App* find_command(const CLI::App& program, std::string_view name) {
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

std::optional<std::string> find_missing_value(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* command = argc > 1 ? find_command(program, argv[1]) : nullptr;
  if (command == nullptr) return std::nullopt;
  for (int k = 2; k + 1 < argc && std::string_view(argv[k]) != "--"; ++k) {
    const CLI::Option* option = find_option(*command, argv[k]);
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    ++k;
    if (reads_as_option(*command, argv[k]))
      return fmt::format("{} needs a value, and {} behind it reads as an option", option->get_name(), argv[k]);
  }
  return std::nullopt;
}

}  // namespace scarp::cli
