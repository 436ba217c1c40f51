#include "session/options/points_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr std::pair<const char*, DuplicatePolicy> kPolicies[] = {{"first", DuplicatePolicy::kFirst},
                                                                 {"last", DuplicatePolicy::kLast},
                                                                 {"highest", DuplicatePolicy::kHighest},
                                                                 {"lowest", DuplicatePolicy::kLowest},
                                                                 {"mean", DuplicatePolicy::kMean}};

}  // namespace

void PointsArguments::add_to(CLI::App& command) {
  add_flag(command, OptionId::kPoints, points);
  add_option(command, OptionId::kDuplicates, duplicates);
  add_option(command, OptionId::kLayer, layer);
  add_option(command, OptionId::kZField, z_field);
  add_option(command, OptionId::kColumns, columns);
  add_option(command, OptionId::kBoundary, boundary);
}

Result<void> PointsArguments::check_single(const std::vector<std::string>& paths) const {
  if (paths.size() < 2) return {};
  for (const std::string& path : paths) {
    if (are_meant(path))
      return fail(ErrorKind::kUsage,
                  fmt::format("{} holds points: only rasters are joined, so give it alone", shell_word(path)));
  }
  return {};
}

Result<void> PointsArguments::check_unused(const std::string& path) const {
  const std::pair<const char*, bool> options[] = {{"--duplicates", duplicates.has_value()},
                                                  {"--layer", layer.has_value()},
                                                  {"--z-field", z_field.has_value()},
                                                  {"--boundary", boundary.has_value()}};
  for (const auto& [name, is_given] : options) {
    if (is_given)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for scattered points, and {} is taken for a raster: --points says otherwise", name,
                              shell_word(base_name(path))));
  }
  return {};
}

std::string PointsArguments::canonical() const {
  return std::string(points ? " --points" : "") + canonical_option("--duplicates", duplicates) +
         canonical_option("--layer", layer) + canonical_option("--z-field", z_field) +
         canonical_option("--columns", columns) + canonical_option("--boundary", boundary);
}

const char* policy_name(DuplicatePolicy policy) {
  for (const auto& [name, value] : kPolicies) {
    if (value == policy) return name;
  }
  return "first";
}

Result<DuplicatePolicy> parse_policy(const Given& text) {
  if (!text) return DuplicatePolicy::kFirst;
  for (const auto& [name, value] : kPolicies) {
    if (*text == name) return value;
  }
  return fail(ErrorKind::kUsage, fmt::format("--duplicates {} is unknown: choose first, last, highest, lowest or mean",
                                             shell_word(*text)));
}

Result<std::optional<double>> parse_boundary(const Given& text) {
  constexpr std::string_view kConcave = "concave:";
  if (!text || *text == "hull") return std::optional<double>();
  if (text->starts_with(kConcave)) {
    const Result<double> length = parse_number("--boundary", text->substr(kConcave.size()));
    if (length && *length > 0) return *length;
  }
  return fail(ErrorKind::kUsage,
              fmt::format("--boundary {} is neither hull nor concave:LENGTH, such as concave:50: LENGTH is a number "
                          "above 0 in the unit of x and y",
                          shell_word(*text)));
}

Result<void> refuse_raster_options(const CLI::App& command, const std::string& path) {
  constexpr std::array<std::string_view, 26> kMeant{
      "--max-error",     "--max-triangles", "--max-points",  "--crs",        "--of",      "--base",     "--up",
      "--report",        "--overwrite",     "--num-threads", "--quiet",      "--points",  "--layer",    "--double",
      "--json-progress", "--duplicates",    "--z-field",     "--fail-above", "--json",    "--compress", "--columns",
      "--nodata",        "--z-scale",       "--z-offset",    "--z-unit",     "--boundary"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool is_meant = option->get_positional() || std::find(kMeant.begin(), kMeant.end(), name) != kMeant.end();
    if (option->count() > 0 && !is_meant)
      return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, and {} holds points: leave it out", name,
                                                 shell_word(base_name(path))));
  }
  return {};
}

}  // namespace scarp::cli
