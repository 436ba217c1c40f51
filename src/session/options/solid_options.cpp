#include "session/options/solid_options.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "session/text/paths.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// KEY=VALUE, or KEY without a value.
using Pair = std::pair<std::string, std::optional<std::string>>;

std::vector<Pair> split_pairs(const std::string& text) {
  std::vector<Pair> pairs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::size_t equals = word.find('=');
    pairs.emplace_back(word.substr(0, equals),
                       equals == std::string::npos ? std::nullopt : std::optional(word.substr(equals + 1)));
    begin = end + 1;
  }
  return pairs;
}

struct Length {
  double value = 0;
  bool is_metric = false;  ///< given as mm, cm, m or in
};

/// A length above 0, in millimetres if it has a unit.
Result<Length> parse_length(const std::string& name, const std::string& text) {
  constexpr std::pair<const char*, double> kUnits[] = {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"m", 1000}};
  std::string number = text;
  Length length;
  double factor = 1;
  for (const auto& [unit, millimetres] : kUnits) {
    if (!number.ends_with(unit)) continue;
    number.resize(number.size() - std::string_view(unit).size());
    factor = millimetres;
    length.is_metric = true;
    break;
  }
  const Result<double> value = parse_number(name, number);
  if (!value || !(*value > 0) || !(*value * factor < 1e9))
    return fail(ErrorKind::kUsage, fmt::format("{} {} is no length above 0, such as 120mm", name, shell_word(text)));
  length.value = *value * factor;
  return length;
}

Result<void> refuse_key(OptionId option, const std::string& key, const char* keys) {
  return fail(ErrorKind::kUsage, fmt::format("{} has no key {}: choose {}", option, shell_word(key), keys));
}

Result<void> take_solid(const Pair& pair, PrintOptions& plan, std::vector<std::string>& warnings) {
  const auto& [key, value] = pair;
  const std::string name = fmt::format("{} {}", kSolid, key);
  if (key == "walls" && !value) return {};  // a solid always has walls
  if (!value && parse_length(name, key))
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} names no key: give size={}", kSolid, shell_word(key), shell_word(key)));
  if (key != "base" && key != "thickness" && key != "size" && key != "exaggerate")
    return refuse_key(kSolid, key, "base, thickness, size, exaggerate or walls");
  if (!value) return fail(ErrorKind::kUsage, fmt::format("{} needs a value: {}=VALUE", name, key));
  if (key == "base") {
    if (*value == "auto") return {};
    SCARP_TRY(const double base, parse_number(name, *value));
    if (std::abs(base) > 1e30) return fail(ErrorKind::kUsage, fmt::format("{} {} is out of range", name, *value));
    plan.base = base;
    return {};
  }
  if (key == "exaggerate") {
    SCARP_TRY(const double factor, parse_number(name, *value));
    if (!(factor > 0) || factor > 1e6)
      return fail(ErrorKind::kUsage, fmt::format("{} {} is not above 0 and at most a million", name, *value));
    plan.exaggerate = factor;
    return {};
  }
  SCARP_TRY(const Length length, parse_length(name, *value));
  if (key == "thickness") {
    plan.thickness = plan.printed_thickness = std::nullopt;
    (length.is_metric ? plan.printed_thickness : plan.thickness) = length.value;
  } else {
    plan.size = length.value;
    if (!length.is_metric)
      warnings.push_back(fmt::format("{} {} is taken for millimetres: size={}mm says so", name, *value, *value));
  }
  return {};
}

Result<void> take_split(const Pair& pair, bool is_first, PrintOptions& plan, bool& is_gap_metric) {
  const auto& [key, value] = pair;
  if (is_first && !value) {
    const std::size_t cross = key.find('x');
    const auto number = [](const std::string& text) {
      const bool is_short = !text.empty() && text.size() <= 3;
      const bool is_whole = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
      return is_short && is_whole ? std::stoi(text) : 0;
    };
    plan.columns = number(key.substr(0, cross));
    plan.rows = cross == std::string::npos ? 0 : number(key.substr(cross + 1));
    if (plan.columns >= 1 && plan.rows >= 1 && plan.columns <= 100 && plan.rows <= 100) return {};
  }
  if (is_first)
    return fail(ErrorKind::kUsage, fmt::format("{} {} is no COLUMNSxROWS of print tiles, 1 to 100 each, such as 2x3",
                                               kSplit, shell_word(key + (value ? "=" + *value : ""))));
  if (key == "gap" && value) {
    SCARP_TRY(const Length gap, parse_length(fmt::format("{} gap", kSplit), *value));
    plan.gap = gap.value;
    is_gap_metric = gap.is_metric;
    return {};
  }
  if (key != "joint" || !value) return refuse_key(kSplit, key, "joint or gap");
  constexpr Choice<bool> kJoints[] = {{"none", false}, {"dovetail", true}};
  SCARP_TRY(plan.dovetail, choose(fmt::format("{} joint", kSplit), *value, kJoints));
  return {};
}

}  // namespace

Result<std::optional<PrintOptions>> parse_solid(const GivenOptions& given, std::vector<std::string>& warnings) {
  const Given &solid = given[kSolid], &split = given[kSplit];
  if (!solid) return std::optional<PrintOptions>();
  PrintOptions plan;
  for (const Pair& pair : split_pairs(*solid)) {
    SCARP_RETURN_IF_ERROR(take_solid(pair, plan, warnings));
  }
  if (plan.base && (plan.thickness || plan.printed_thickness))
    return fail(ErrorKind::kUsage, fmt::format("{} base cannot be combined with thickness: drop one of them", kSolid));
  bool is_first = true, is_gap_metric = false;
  for (const Pair& pair : split ? split_pairs(*split) : std::vector<Pair>()) {
    SCARP_RETURN_IF_ERROR(take_split(pair, is_first, plan, is_gap_metric));
    is_first = false;
  }
  for (const auto& [name, is_metric] :
       {std::pair{fmt::format("{} thickness", kSolid), plan.printed_thickness.has_value()},
        std::pair{fmt::format("{} gap", kSplit), is_gap_metric}}) {
    if (is_metric && !plan.size)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} in millimetres needs the size of the print: {} size=120mm", name, kSolid));
  }
  if ((plan.gap > 0 || plan.dovetail) && !plan.is_split())
    return fail(ErrorKind::kUsage, fmt::format("{} 1x1 has no neighbours: leave joint and gap out", kSplit));
  return std::optional(plan);
}

std::string tile_path(const std::string& output, int row, int column) {
  const std::size_t point = output.size() - lower_extension(output).size();
  return fmt::format("{}-r{}-c{}{}", output.substr(0, point), row, column, output.substr(point));
}

}  // namespace scarp::cli
