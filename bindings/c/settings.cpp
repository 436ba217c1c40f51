#include "settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>

#include "door.h"
#include "session/table/unknown_words.h"

namespace scarp::door {
namespace {

using cli::Commands;
using cli::OptionId;
using cli::OptionRow;
using cli::OptionType;

constexpr Commands kDoorCommands = cli::kClassic | cli::kMeasure | cli::kTile;

/// True for options that only a program needs: for its terminal, its files, or several meshes.
bool is_of_program(const OptionRow& row) {
  constexpr OptionId kOfProgram[] = {OptionId::kOverwrite, OptionId::kQuiet,     OptionId::kTiming,
                                     OptionId::kJson,      OptionId::kPoints,    OptionId::kJsonProgress,
                                     OptionId::kLods,      OptionId::kLodsInOne, OptionId::kHelp,
                                     OptionId::kHelpAll,   OptionId::kVersion};
  if (row.part_of != OptionId::kNone && is_of_program(*cli::find_option(kDoorCommands, row.part_of))) return true;
  return row.is_argument() || row.type == OptionType::kOutputFile || row.type == OptionType::kFolder ||
         std::find(std::begin(kOfProgram), std::end(kOfProgram), row.id) != std::end(kOfProgram);
}

std::string without_dashes(std::string name) {
  name.erase(0, 2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

Result<void> check_name(const std::string& name) {
  const OptionRow* const row = cli::find_option(kDoorCommands, name);
  if (row != nullptr && !is_of_program(*row)) return {};
  if (row != nullptr) {
    return fail(ErrorKind::kUsage, fmt::format("option {} is the program's alone: it is about its terminal, its files, "
                                               "or several meshes",
                                               name));
  }
  if (const std::string bare = without_dashes(name); bare == "o" || bare == "out" || bare == "output")
    return fail(ErrorKind::kUsage,
                "option " + bare + " is unknown: a mesh is in memory, and scarp_mesh_write() makes a file of it");
  CLI::App program;
  for (const Commands command : {cli::kSimplify, cli::kMeasure, cli::kTile}) {
    const std::string sentence = cli::describe_unknown_option(program.add_subcommand(cli::command_name(command)), name);
    if (command == cli::kTile || sentence.ends_with(")"))
      return fail(ErrorKind::kUsage, "option " + without_dashes(name) + sentence.substr(sentence.find(" is unknown")));
  }
  return {};
}

std::optional<bool> find_truth(const std::string& value) {
  for (const char* yes : {"", "true", "True", "1", "yes", "on"}) {
    if (value == yes) return true;
  }
  for (const char* no : {"false", "False", "0", "no", "off"}) {
    if (value == no) return false;
  }
  return std::nullopt;
}

/// Appends the command-line words for the option.
Result<void> add_words(const OptionRow& row, const std::string& value, std::vector<std::string>& words) {
  const std::string name = row.name;
  if (row.type == OptionType::kFlag) {
    const std::optional<bool> truth = find_truth(value);
    if (!truth) return fail(ErrorKind::kUsage, fmt::format("{} '{}' is neither true nor false", name, value));
    if (*truth) words.push_back(name);
    return {};
  }
  if (value.empty()) return fail(ErrorKind::kUsage, name + " has no value");
  if (std::string_view(row.value).find(' ') == std::string_view::npos) {
    words.push_back(name + "=" + value);
    return {};
  }
  words.push_back(name);
  const auto split = [](const std::string& text) {
    std::istringstream parts(text);
    return std::vector<std::string>(std::istream_iterator<std::string>(parts), {});
  };
  const std::vector<std::string> given = split(value);
  if (given.size() != split(row.value).size())
    return fail(ErrorKind::kUsage, fmt::format("{} takes {}, and '{}' was given", name, row.value, value));
  words.insert(words.end(), given.begin(), given.end());
  return {};
}

/// The members of the struct as options by name.
std::vector<std::pair<std::string, std::string>> common_settings(const scarp_options& asked) {
  std::vector<std::pair<std::string, std::string>> settings;
  if (!std::isnan(asked.max_error)) settings.emplace_back("--max-error", fmt::format("{}", asked.max_error));
  if (asked.max_triangles != 0) settings.emplace_back("--max-triangles", fmt::format("{}", asked.max_triangles));
  if (asked.max_points != 0) settings.emplace_back("--max-points", fmt::format("{}", asked.max_points));
  if (asked.threads != 0) settings.emplace_back("--num-threads", fmt::format("{}", asked.threads));
  if (asked.mask != nullptr) settings.emplace_back("--mask", "mask");
  if (asked.tolerance != nullptr) settings.emplace_back("--tolerance", "tolerance");
  return settings;
}

}  // namespace

std::string name_in_program(const std::string& name) {
  if (std::string named = find_named_here(name); !named.empty()) return named;
  std::string text = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::replace(text.begin(), text.end(), '_', '-');
  while (text.ends_with('-')) text.pop_back();  // Python's class_
  return "--" + text;
}

bool has_setting(const scarp_options& asked, const char* name) {
  if (asked.named == nullptr) return false;
  const auto& values = asked.named->values;
  return std::any_of(values.begin(), values.end(), [&](const auto& setting) { return setting.first == name; });
}

Result<std::vector<std::string>> words_of(Commands command, const std::vector<std::string>& arguments,
                                          const scarp_options& asked, const std::vector<std::string>& beside) {
  std::vector<std::string> words{arguments.front()};
  words.insert(words.end(), beside.begin(), beside.end());
  const auto add = [&](const std::string& name, const std::string& value) -> Result<void> {
    const OptionRow* const row = cli::find_option(command, name);
    if (row == nullptr)
      return fail(ErrorKind::kUsage,
                  fmt::format("option {} has no meaning here: no such option of 'scarp {}'", name, words.front()));
    return add_words(*row, value, words);
  };
  for (const auto& [name, value] : common_settings(asked)) {
    if (has_setting(asked, name.c_str())) continue;
    SCARP_RETURN_IF_ERROR(add(name, value));
  }
  if (asked.named != nullptr) {
    for (const auto& [name, value] : asked.named->values) {
      SCARP_RETURN_IF_ERROR(add(name, value));
    }
  }
  words.emplace_back("--");  // the following words are names, which may begin with a dash
  words.insert(words.end(), arguments.begin() + 1, arguments.end());
  return words;
}

Result<void> parse_words(CLI::App& program, std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the order that CLI11 expects
  try {
    program.parse(words);
  } catch (const CLI::ParseError& error) {
    return fail(ErrorKind::kUsage, error.what());
  }
  return {};
}

Result<void> parse_options(CLI::App& program, Commands command, const std::vector<std::string>& arguments,
                           const scarp_options& asked, const std::vector<std::string>& beside) {
  SCARP_TRY(auto&& words, words_of(command, arguments, asked, beside));
  return parse_words(program, std::move(words));
}

}  // namespace scarp::door

using namespace scarp::door;

extern "C" {

scarp_status scarp_options_set(scarp_options* options, const char* name, const char* value) {
  return guarded([&]() -> scarp_status {
    if (options == nullptr || name == nullptr)
      return report(scarp::ErrorKind::kUsage, "the options, or the name of one, are a null pointer");
    check_size(options);
    if (options->struct_size < offsetof(scarp_options, named) + sizeof options->named)
      return report(scarp::ErrorKind::kUsage, "the scarp_options end before named: set struct_size to their size");
    const std::string word = name_in_program(name);
    if (auto checked = check_name(word); !checked) return report(checked.error());
    if (options->named == nullptr) options->named = new scarp_settings;
    auto& values = options->named->values;
    const bool adds = value != nullptr && scarp::cli::find_option(kDoorCommands, word)->is_repeatable;
    if (!adds) std::erase_if(values, [&](const auto& setting) { return setting.first == word; });
    if (value != nullptr) values.emplace_back(word, value);
    return SCARP_OK;
  });
}

void scarp_options_clear(scarp_options* options) {
  if (options == nullptr || !is_struct_size(options->struct_size) ||
      options->struct_size < offsetof(scarp_options, named) + sizeof options->named)
    return;
  delete options->named;
  options->named = nullptr;
}

}  // extern "C"
