#include "session/table/option_table.h"

#include <algorithm>
#include <array>
#include <stdexcept>

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

std::string OptionRow::range_text() const {
  if (range[0] != 0) return range;
  if (above != -kNoLimit)
    return fmt::format("above {}", above) + (most != kNoLimit ? fmt::format(", at most {}", most) : "");
  if (least == -kNoLimit) return "";
  return most == kNoLimit ? fmt::format("at least {}", least) : fmt::format("{} to {}", least, most);
}

std::string OptionRow::title() const { return part_of == OptionId::kNone ? name : fmt::format("{} {}", part_of, key); }

int OptionRow::value_count() const {
  if (type == OptionType::kFlag) return 0;
  return 1 + static_cast<int>(std::count(value, value + std::string_view(value).size(), ' '));
}

std::span<const GroupRow> group_rows() { return kGroups; }

std::vector<const OptionRow*> rows_of(Commands command) {
  std::vector<const OptionRow*> rows;
  for (const OptionRow* row : all_rows()) {
    if ((row->commands & command) != 0) rows.push_back(row);
  }
  return rows;
}

std::vector<const OptionRow*> accepted_rows(Commands command) {
  return rows_of(command == kSimplify ? kClassic : command);
}

const OptionRow* find_option(Commands commands, OptionId id) {
  for (const OptionRow* row : accepted_rows(commands)) {
    if (row->id == id) return row;
  }
  return nullptr;
}

const OptionRow* find_option(Commands commands, std::string_view name) {
  for (const OptionRow* row : accepted_rows(commands)) {
    if (row->name == name || (!name.empty() && row->short_name == name)) return row;
  }
  return nullptr;
}

const CommandRow* find_command(std::string_view name) {
  for (const CommandRow& row : command_rows()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

const char* type_name(OptionType type) {
  switch (type) {
    case OptionType::kFlag:
      return "flag";
    case OptionType::kNumber:
      return "number";
    case OptionType::kCount:
      return "count";
    case OptionType::kText:
      return "text";
    case OptionType::kChoice:
      return "choice";
    case OptionType::kInputFile:
    case OptionType::kOutputFile:
      return "file";
    case OptionType::kFolder:
      break;
  }
  return "folder";
}

const char* command_name(Commands command) {
  for (const CommandRow& row : command_rows()) {
    if (row.command == command) return row.name;
  }
  throw std::logic_error("a command is not in the table");
}

std::string name_of(const OptionTerm& term) {
  return name_of(term.id) + (term.value[0] != 0 ? std::string(" ") + term.value : "");
}

const std::string& name_of(OptionId id) {
  constexpr auto kCount = static_cast<std::size_t>(OptionId::kNone);
  static const std::array<std::string, kCount> kNames = [] {
    std::array<std::string, kCount> names;
    for (const bool are_parts : {false, true}) {  // the name of a part contains its option's name
      for (const OptionRow* row : all_rows()) {
        std::string& name = names[static_cast<std::size_t>(row->id)];
        if ((row->part_of != OptionId::kNone) != are_parts || !name.empty()) continue;
        name = are_parts ? names[static_cast<std::size_t>(row->part_of)] + " " + row->key : row->name;
      }
    }
    return names;
  }();
  return kNames[static_cast<std::size_t>(id)];
}

}  // namespace scarp::cli
