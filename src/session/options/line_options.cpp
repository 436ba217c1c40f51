#include "session/options/line_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/commands.h"
#include "scarp/raster_lines.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr Choice<LineConflict> kConflicts[] = {{"error", LineConflict::kError},
                                               {"first", LineConflict::kFirst},
                                               {"mean", LineConflict::kMean},
                                               {"highest", LineConflict::kHighest}};

double largest_edit(const std::vector<SampleEdit>& edits) {
  double largest = 0;
  for (const SampleEdit& edit : edits) largest = std::max(largest, std::abs(double{edit.after} - double{edit.before}));
  return largest;
}

}  // namespace

Result<std::vector<Line>> read_files(const std::vector<std::string>& files, const ReadLinesOptions& options,
                                     std::vector<std::string>& warnings) {
  auto set = read_lines(files, options);
  if (!set) return tl::unexpected(std::move(set.error()));
  warnings.insert(warnings.end(), set->warnings.begin(), set->warnings.end());
  return std::move(set->lines);
}

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
    const Result<double> share = parse_non_negative("--water-percentile", *percentile);
    if (!share) return tl::unexpected(share.error());
    if (*share > 100)
      return fail(ErrorKind::kUsage, fmt::format("--water-percentile {} is above 100", shell_word(*percentile)));
  }
  if (flats) {
    if (!water.empty())
      return fail(ErrorKind::kUsage,
                  "--detect-flats cannot be combined with --water: lakes are found, or named by a file");
    const Result<std::uint64_t> samples = parse_count("--detect-flats", *flats, 3);
    if (!samples) return tl::unexpected(samples.error());
  }
  if (!conflict) return {};
  const Result<LineConflict> rule = choose("--line-conflict", *conflict, kConflicts);
  return rule ? Result<void>() : tl::unexpected(rule.error());
}

Result<void> check_frame_of_lines(const char* lines, const Frame& frame, const std::string& crs_option,
                                  const std::string& input) {
  if (lines == nullptr || frame.is_affine()) return {};
  const std::string crs = shell_word(crs_option);
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} cannot be combined with --crs {}: lines are inserted where the grid is regular, and in that "
                  "CRS it is bent. Leave --crs out, or bend the raster first ({})",
                  lines, crs, warp_command("-t_srs " + crs, input)));
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

Result<LineConstraints> LineArguments::read(const RasterInfo& raster, int rows, const ProgressCallback& progress,
                                            std::vector<std::string>& warnings) const {
  LineConstraints constraints;
  constraints.affine = map_affine(raster, rows);
  if (conflict) constraints.conflict = *choose("--line-conflict", *conflict, kConflicts);
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.z_field = z_field.value_or("");
  options.ignore_z = are_soft;
  options.progress = progress;
  auto set = read_lines(breaklines, options, raster);
  if (!set) return tl::unexpected(std::move(set.error()));
  warnings.insert(warnings.end(), set->warnings.begin(), set->warnings.end());
  constraints.lines = std::move(set->lines);
  // Their heights are the file's, as the raster's are.
  for (Line& each : constraints.lines) {
    for (auto& point : each.points) point[2] = raster.z_scale * point[2] + raster.z_offset;
  }
  return constraints;
}

Json describe_lines(const LineArguments& given, const Simplified& simplified) {
  if (given.breaklines.empty()) return nullptr;
  const FarthestLine& farthest = simplified.farthest_line;
  return Json{{"files", given.breaklines},
              {"lines", simplified.features.given_lines()},
              {"laid", simplified.lines_inserted},
              {"edited_samples", simplified.edits.size()},
              {"largest_edit", largest_edit(simplified.edits)},
              {"farthest", farthest.distance},
              {"farthest_line", farthest.name},
              {"farthest_is_at_zero", farthest.is_at_zero}};
}

void warn_of_far_lines(const Simplified& simplified, double error, std::vector<std::string>& warnings) {
  constexpr double kMostErrors = 10;
  const FarthestLine& line = simplified.farthest_line;
  // Zeros seldom are heights, so that they need not lie far from the raster.
  if (line.distance > (line.is_at_zero ? 1 : kMostErrors) * error) {
    warnings.push_back(fmt::format(
        "--breaklines: {} lies up to {} from the raster{}: {}--soft-breaklines takes the "
        "heights of lines from the raster",
        line.name, format_number(line.distance), line.is_at_zero ? ", and all its heights are 0" : "",
        line.is_at_zero ? "--breakline-z names an attribute with heights, and " : "if its heights are wrong, "));
  }
  const std::vector<River>& rivers = simplified.features.rivers;
  const auto deepest = std::max_element(rivers.begin(), rivers.end(),
                                        [](const River& a, const River& b) { return a.deepest_cut < b.deepest_cut; });
  if (deepest != rivers.end() && deepest->deepest_cut > kMostErrors * error) {
    warnings.push_back(
        fmt::format("--rivers: {} runs up to {} below the raster, for it crosses higher ground: draw it "
                    "along the valley, or give its file to --breaklines, with --soft-breaklines, which "
                    "cuts nothing",
                    deepest->name, format_number(deepest->deepest_cut)));
  }
}

std::string lines_line(std::uint64_t lines, std::uint64_t inserted, const std::vector<SampleEdit>& edits) {
  if (lines == 0) return "";
  std::string text = format_plural(lines, "line");
  if (inserted != lines) {
    text = fmt::format("{} of {}, the {} beside the raster", inserted == 0 ? "none" : format_count(inserted), text,
                       lines - inserted == 1 ? "other lies" : "others lie");
  }
  if (!edits.empty())
    text += fmt::format("; {} given their heights (changed by at most {}); errors are relative to the changed raster",
                        format_plural(edits.size(), "sample"), format_number(largest_edit(edits)));
  return summary_line("breaklines", text);
}

}  // namespace scarp::cli
