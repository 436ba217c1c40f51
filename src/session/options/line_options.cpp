#include "session/options/line_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr Choice<LineConflict> kConflicts[] = {{"error", LineConflict::kError},
                                               {"first", LineConflict::kFirst},
                                               {"mean", LineConflict::kMean},
                                               {"highest", LineConflict::kHighest}};

}  // namespace

void LineArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kBreaklines, breaklines);
  add_option(command, OptionId::kBreaklineZ, z_field);
  add_flag(command, OptionId::kSoftBreaklines, are_soft);
  add_option(command, OptionId::kLineConflict, conflict);
  add_option(command, OptionId::kWater, water);
  add_option(command, OptionId::kWaterPercentile, percentile);
  add_option(command, OptionId::kDetectFlats, flats);
  add_option(command, OptionId::kRivers, rivers);
}

const char* LineArguments::find_lines() const {
  if (!breaklines.empty()) return "--breaklines";
  if (const char* lakes = find_lakes()) return lakes;
  return rivers.empty() ? nullptr : "--rivers";
}

const char* LineArguments::find_lakes() const {
  if (!water.empty()) return "--water";
  return flats ? "--detect-flats" : nullptr;
}

Result<void> LineArguments::check() const {
  const char* needing = z_field    ? "--breakline-z"
                        : are_soft ? "--soft-breaklines"
                        : conflict ? "--line-conflict"
                                   : nullptr;
  const bool may_meet = conflict && !are_soft && !z_field && (!rivers.empty() || !water.empty());
  if (needing != nullptr && breaklines.empty() && !may_meet)
    return fail(ErrorKind::kUsage, fmt::format("{} needs --breaklines: there are no lines without", needing));
  if (are_soft && z_field)
    return fail(ErrorKind::kUsage, "--soft-breaklines cannot be combined with --breakline-z; drop one of them");
  if (percentile) {
    if (water.empty()) return fail(ErrorKind::kUsage, "--water-percentile needs --water: there is no lake without");
    SCARP_TRY(const double share, parse_non_negative("--water-percentile", *percentile));
    if (share > 100)
      return fail(ErrorKind::kUsage, fmt::format("--water-percentile {} is above 100", shell_word(*percentile)));
  }
  if (flats) {
    if (!water.empty())
      return fail(ErrorKind::kUsage,
                  "--detect-flats cannot be combined with --water: lakes are found, or named by a file");
    SCARP_RETURN_IF_ERROR(parse_count("--detect-flats", *flats, 3));
  }
  if (!conflict) return {};
  const Result<LineConflict> rule = choose("--line-conflict", *conflict, kConflicts);
  return rule ? Result<void>() : tl::unexpected(rule.error());
}

std::optional<LineConflict> LineArguments::conflict_rule() const {
  if (!conflict) return std::nullopt;
  return *choose("--line-conflict", *conflict, kConflicts);
}

std::string LineArguments::canonical() const {
  std::string text;
  for (const std::string& file : breaklines) text += " --breaklines " + shell_word(base_name(file));
  text += canonical_option("--breakline-z", z_field) + (are_soft ? " --soft-breaklines" : "") +
          canonical_option("--line-conflict", conflict);
  for (const std::string& file : water) text += " --water " + shell_word(base_name(file));
  text += canonical_option("--water-percentile", percentile) + canonical_option("--detect-flats", flats);
  for (const std::string& file : rivers) text += " --rivers " + shell_word(base_name(file));
  return text;
}

}  // namespace scarp::cli
