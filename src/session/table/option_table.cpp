#include "session/table/option_table.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

#include "scarp/version.h"
#include "session/table/option_rows.h"

namespace scarp::cli {
namespace {

constexpr GroupRow kGroups[] = {
    {OptionGroup::kArguments, "Arguments", ""},
    {OptionGroup::kGoals, "Goals", "at least one; the first that is reached ends the run"},
    {OptionGroup::kVerdict, "Verdict", ""},
    {OptionGroup::kField, "Field", ""},
    {OptionGroup::kInput, "Input", ""},
    {OptionGroup::kOutput, "Output", ""},
    {OptionGroup::kEffort, "Effort", "fewer triangles for more time"},
    {OptionGroup::kLevels, "Levels", "of detail, and borders that neighbours share"},
    {OptionGroup::kNodata, "Nodata", "missing samples"},
    {OptionGroup::kWhereItMatters, "Where it matters", "rasters on the grid of the heights, and vector files"},
    {OptionGroup::kLines, "Lines", "breaklines, cutlines, walls, ridges and valleys"},
    {OptionGroup::kWater, "Water", ""},
    {OptionGroup::kShape, "Shape", "for simulation: vertices are added until it holds"},
    {OptionGroup::kSolids, "Solids", "for printing"},
    {OptionGroup::kMemory, "Memory", ""},
    {OptionGroup::kRun, "Run", ""},
    {OptionGroup::kTextures, "Textures and images", ""},
    {OptionGroup::kPoints, "Scattered points", ".csv, .xyz, .gpkg, .geojson, .shp ..."},
    {OptionGroup::kStrategies, "The 1995 paper's strategies", "the promise stays the same"},
};

std::vector<const OptionRow*> sort_rows() {
  std::vector<const OptionRow*> rows;
  for (const auto part :
       {goal_rows(), file_rows(), sample_rows(), line_rows(), strategy_rows(), tile_rows(), run_rows()}) {
    for (const OptionRow& row : part) rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const OptionRow* a, const OptionRow* b) { return a->group < b->group; });
  return rows;
}

const std::vector<const OptionRow*>& all_rows() {
  static const std::vector<const OptionRow*> kAll = sort_rows();
  return kAll;
}

const OptionRow& row_of(const CLI::App& command, OptionId id) {
  const CommandRow* const owner = find_command(command.get_name());
  if (owner != nullptr) {
    for (const OptionRow* row : rows_of(owner->command)) {
      if (row->id == id) return *row;
    }
  }
  throw std::logic_error(fmt::format("option {} of {} is not in the table", static_cast<int>(id), command.get_name()));
}

/// The names as CLI11 expects them: "-e,--max-error".
std::string names_of(const OptionRow& row) {
  return std::string(row.short_name) + (row.short_name[0] != 0 ? "," : "") + row.name;
}

template <class T>
CLI::Option* add(CLI::App& command, OptionId id, T& value) {
  const OptionRow& row = row_of(command, id);
  return command.add_option(names_of(row), value)->required(row.is_required);
}

}  // namespace

std::vector<std::string> OptionRow::list_choices() const {
  std::vector<std::string> words;
  for (std::string_view rest = choices; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

std::string OptionRow::value_text() const {
  if (type == OptionType::kFlag || is_argument()) return "";
  if (value[0] != 0) return value;
  std::string text;
  for (const std::string& word : list_choices()) text += (text.empty() ? "" : "|") + word;
  return text;
}

std::span<const GroupRow> group_rows() { return kGroups; }

std::vector<const OptionRow*> rows_of(Commands command) {
  std::vector<const OptionRow*> rows;
  for (const OptionRow* row : all_rows()) {
    if ((row->commands & command) != 0) rows.push_back(row);
  }
  return rows;
}

const OptionRow* find_option(Commands commands, std::string_view name) {
  for (const OptionRow* row : all_rows()) {
    if ((row->commands & commands) != 0 && (row->name == name || (!name.empty() && row->short_name == name)))
      return row;
  }
  return nullptr;
}

const CommandRow* find_command(std::string_view name) {
  for (const CommandRow& row : command_rows()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

void add_option(CLI::App& command, OptionId id, std::string& value) { add(command, id, value); }

void add_option(CLI::App& command, OptionId id, std::optional<std::string>& value) { add(command, id, value); }

void add_option(CLI::App& command, OptionId id, std::vector<std::string>& values) {
  add(command, id, values)->allow_extra_args(false);  // one value each time that the option is given
}

void add_arguments(CLI::App& command, OptionId id, std::vector<std::string>& values) { add(command, id, values); }

void add_arguments(CLI::App& command, OptionId id, std::vector<std::string>& values, OptionId last_id,
                   std::string& last) {
  add(command, id, values);
  // CLI11 gives all arguments to the first that accepts several.
  add(command, last_id, last)->required(false);
  command.parse_complete_callback([&values, &last, name = row_of(command, last_id).name] {
    if (values.empty()) return;  // CLI11 reports that
    if (values.size() == 1) throw CLI::RequiredError(name);
    last = std::move(values.back());
    values.pop_back();
  });
}

void add_numbers(CLI::App& command, OptionId id, std::vector<std::string>& values, int count) {
  add(command, id, values)->expected(count);
}

void add_flag(CLI::App& command, OptionId id, bool& value) { command.add_flag(names_of(row_of(command, id)), value); }

std::vector<std::string> files_read(const CLI::App& command) {
  std::vector<std::string> files;
  const CommandRow* const owner = find_command(command.get_name());
  if (owner == nullptr) return files;
  const std::vector<const OptionRow*> rows = rows_of(owner->command);
  const auto is_output = [](const OptionRow* row) {
    return row->is_argument() && row->type == OptionType::kOutputFile;
  };
  const bool ends_in_output = std::any_of(rows.begin(), rows.end(), is_output);
  for (const OptionRow* row : rows) {
    if (row->type != OptionType::kInputFile) continue;
    const CLI::Option* const option = command.get_option_no_throw(row->name);
    if (option == nullptr) continue;
    std::vector<std::string> values = option->results();
    // CLI11 gives all arguments to the first that accepts several: see add_arguments().
    if (row->is_argument() && row->is_repeatable && ends_in_output && !values.empty()) values.pop_back();
    for (std::string& value : values) {
      if (std::string_view(row->value).ends_with("=M")) value.resize(std::min(value.rfind('='), value.size()));
      files.push_back(std::move(value));
    }
  }
  return files;
}

CLI::App* add_command(CLI::App& program, Commands command) {
  for (const CommandRow& row : command_rows()) {
    if (row.command != command) continue;
    CLI::App* const added = program.add_subcommand(row.name);
    added->set_version_flag("--version", fmt::format("scarp {}", scarp::version()));
    return added;
  }
  throw std::logic_error("a command is not in the table");
}

}  // namespace scarp::cli
