#include "session/table/help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "scarp/io.h"
#include "scarp/version.h"
#include "session/table/conflict_words.h"
#include "session/table/format_words.h"

namespace scarp::cli {
namespace {

constexpr std::size_t kWidth = 100, kColumn = 33;
constexpr std::ptrdiff_t kScreen = 40;  // lines

/// Wraps the words at kWidth; all lines but the first are indented by kColumn blanks.
std::string wrap(const std::string& text) {
  std::string wrapped;
  std::size_t at = kColumn;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (at > kColumn && at + 1 + word.size() > kWidth) {
      wrapped += "\n" + std::string(kColumn, ' ');
      at = kColumn;
    }
    if (at > kColumn) wrapped += ' ', ++at;
    wrapped += word;
    at += word.size();
    begin = end + 1;
  }
  return wrapped + "\n";
}

/// `left`, and the text to its right, or below it if `left` is wide.
std::string entry(const std::string& left, const std::string& text) {
  const bool is_wide = left.size() + 2 > kColumn;
  return left + (is_wide ? "\n" : "") + std::string(is_wide ? kColumn : kColumn - left.size(), ' ') + wrap(text);
}

/// The help with the range, the default and repeatability.
std::string full_help(const OptionRow& row) {
  std::string text = row.help;
  if (const std::string range = row.range_text(); range.find(" to ") != std::string::npos)
    text += fmt::format(" From {}.", range);
  if (row.by_default[0] != 0) text += fmt::format(" Default: {}.", row.by_default);
  if (row.is_repeatable) text += " May be given again.";
  return text;
}

/// "  -e, --max-error M|P%"
std::string left_of(const OptionRow& row) {
  if (row.is_argument()) return fmt::format("  {}", row.name);
  const std::string value = row.value_text();
  if (row.part_of != OptionId::kNone) return fmt::format("        ,{}{}{}", row.key, value.empty() ? "" : "=", value);
  return fmt::format("  {:<4}{}{}{}", row.short_name[0] != 0 ? std::string(row.short_name) + "," : "", row.name,
                     value.empty() ? "" : " ", value);
}

std::string title_of(const GroupRow& group) {
  return fmt::format("\n{}{}:\n", group.name, group.note[0] != 0 ? fmt::format(" ({})", group.note) : "");
}

/// Groups the rows by subject.
std::string list_options(const std::vector<const OptionRow*>& rows) {
  std::string text;
  for (const GroupRow& group : group_rows()) {
    std::string entries;
    for (const OptionRow* row : rows) {
      if (row->group == group.group) entries += entry(left_of(*row), full_help(*row));
    }
    if (!entries.empty()) text += title_of(group) + entries;
  }
  return text;
}

/// The spellings of version 0.1, which are accepted until 0.4.
std::string list_old_spellings(const CommandRow& command) {
  std::string text;
  if (command.command == kClassic) return "";
  for (const OptionRow* row : accepted_rows(command.command)) {
    const bool is_of_classic = (row->commands & command.command) == 0;
    if (row->part_of == OptionId::kNone && !is_of_classic) continue;
    const std::string value = row->value_text();
    text +=
        entry(fmt::format("  {}{}{}", row->name, value.empty() ? "" : " ", value),
              is_of_classic ? fmt::format("scarp {}", command_name(kClassic))
                            : fmt::format("{} ...,{}{}{}", row->part_of, row->key, value.empty() ? "" : "=", value));
  }
  return text.empty() ? "" : "\nOld spellings (until 0.4):\n" + text;
}

/// True for a goal that -h lists.
bool is_brief_goal(const OptionRow* row) {
  return row->brief[0] != 0 && (row->group == OptionGroup::kGoals || row->group == OptionGroup::kVerdict);
}

/// Arguments, goals or the verdict, and the most used other options.
std::string list_briefly(const std::vector<const OptionRow*>& rows) {
  std::string arguments, goals, others;
  for (const OptionRow* row : rows) {
    if (row->brief[0] == 0) continue;
    if (is_brief_goal(row) && goals.empty()) {
      goals = title_of(*std::find_if(group_rows().begin(), group_rows().end(),
                                     [&](const GroupRow& group) { return group.group == row->group; }));
    }
    std::string& part = row->group == OptionGroup::kArguments ? arguments : is_brief_goal(row) ? goals : others;
    part += entry(left_of(*row), row->brief);
  }
  return arguments + goals + "\nMost used (all: --help-all):\n" + others;
}

nlohmann::ordered_json describe_option(const OptionRow& row, const CommandRow& command) {
  const auto or_null = [](const char* text) { return text[0] != 0 ? nlohmann::ordered_json(text) : nullptr; };
  const GroupRow& group = *std::find_if(group_rows().begin(), group_rows().end(),
                                        [&](const GroupRow& candidate) { return candidate.group == row.group; });
  return {{"name", row.name},
          {"short", or_null(row.short_name)},
          {"command", command.name},
          {"part_of", or_null(row.part_of == OptionId::kNone ? "" : name_of(row.part_of).c_str())},
          {"key", or_null(row.key)},
          {"group", group.name},
          {"type", type_name(row.type)},
          {"value", or_null(row.value_text().c_str())},
          {"unit", or_null(row.unit)},
          {"default", or_null(row.by_default)},
          {"range", or_null(row.range_text().c_str())},
          {"choices", row.list_choices()},
          {"repeatable", row.is_repeatable},
          {"required", row.is_required},
          {"help", row.help},
          {"brief", or_null(row.brief)}};
}

nlohmann::ordered_json describe_format(const MeshFormatTraits& traits) {
  const auto name_of = [](DefaultFrame frame) {
    return frame == DefaultFrame::kLocal ? "local" : frame == DefaultFrame::kSource ? "source" : "metric";
  };
  return {{"name", traits.name},
          {"title", traits.title},
          {"endings", list_endings(traits)},
          {"media_type", traits.media_type[0] != 0 ? nlohmann::ordered_json(traits.media_type) : nullptr},
          {"read", traits.is_read},
          {"frame", name_of(traits.frame)},
          {"up", std::string(1, traits.up)},
          {"float32", traits.is_float32},
          {"attributes", traits.holds_attributes},
          {"zones", traits.holds_zones},
          {"degrees", !traits.has_lengths_only},
          {"solids_only", traits.holds_solids_only}};
}

}  // namespace

std::string program_help() {
  std::string text =
      "Height fields to triangle meshes with a proven error bound.\n\n"
      "Usage: scarp COMMAND [OPTIONS]\n\n"
      "Commands:\n";
  for (const CommandRow& command : command_rows()) text += fmt::format("  {:<12}{}\n", command.name, command.summary);
  return text +
         "\nOptions:\n"
         "  -h, --help  Print this help\n"
         "  --version   Print the version\n"
         "\nTry:\n"
         "  scarp info dem.tif                                its contents, and errors that suit it\n"
         "  scarp simplify dem.tif hills.glb -e 1             a mesh within 1 m of every sample\n"
         "  scarp measure dem.tif hills.glb --fail-above 1    check the mesh independently\n"
         "'scarp help COMMAND' explains a command, 'scarp COMMAND --help-all' lists all of its options.\n";
}

std::string command_help(const CommandRow& command, bool all) {
  const std::string head = fmt::format("{}.\n\nUsage: scarp {} {}\n", command.summary, command.name, command.usage);
  std::vector<const OptionRow*> rows = rows_of(command.command);
  if (command.command == kClassic)  // the notes refer to simplify for the other options
    std::erase_if(rows, [](const OptionRow* row) {
      return row->group != OptionGroup::kStrategies && row->group != OptionGroup::kArguments;
    });
  const std::string page = head + list_options(rows) + list_old_spellings(command) + "\n" + command.notes;
  if (all || std::count(page.begin(), page.end(), '\n') <= kScreen) return page;
  return head + list_briefly(rows) + "\n" + command.notes;
}

std::string help_json(const CommandRow* command) {
  nlohmann::ordered_json table{{"scarp", version()}};
  table["commands"] = nlohmann::ordered_json::array();
  table["options"] = nlohmann::ordered_json::array();
  table["formats"] = nlohmann::ordered_json::array();
  for (const MeshFormatTraits* traits : mesh_formats()) table["formats"].push_back(describe_format(*traits));
  for (const CommandRow& row : command_rows()) {
    if (command != nullptr && row.command != command->command) continue;
    table["commands"].push_back({{"name", row.name}, {"usage", row.usage}, {"help", row.summary}});
    for (const OptionRow* option : rows_of(row.command)) table["options"].push_back(describe_option(*option, row));
  }
  if (command == nullptr) table["conflicts"] = describe_conflicts();
  return table.dump(2) + "\n";
}

std::string choose_command() {
  std::string text;
  const auto rows = command_rows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    text += (k == 0 ? "choose " : k + 1 == rows.size() ? " or " : ", ") + std::string(rows[k].name);
  return text;
}

void check_table(const CLI::App& program) {
  for (const CommandRow& command : command_rows()) {
    const CLI::App* const taken = program.get_subcommand(command.name);
    for (const OptionRow* row : rows_of(command.command)) {
      if (taken->get_option_no_throw(row->name) == nullptr)
        throw std::logic_error(fmt::format("{} does not take {}", command.name, row->name));
    }
  }
}

}  // namespace scarp::cli
