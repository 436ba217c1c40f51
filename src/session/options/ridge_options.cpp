#include "session/options/ridge_options.h"

#include <fmt/format.h>

#include <utility>

#include "session/inputs/memory.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {

void RidgeArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kRidges, height);
  add_flag(command, OptionId::kKeepRidges, are_kept);
}

Result<void> RidgeArguments::check(bool has_error) const {
  if (are_kept && !height) return fail(ErrorKind::kUsage, "--keep-ridges needs --ridges: there are none without");
  if (!height) return {};
  const Result<double> above = parse_non_negative("--ridges", *height);
  if (!above) return tl::unexpected(above.error());
  if (*above == 0) return fail(ErrorKind::kUsage, "--ridges 0 would make a ridge of all noise: it must be above 0");
  if (!has_error)
    return fail(ErrorKind::kUsage, "--ridges needs --max-error, or a budget: lines are fitted to one bound");
  return {};
}

std::string RidgeArguments::canonical() const {
  return canonical_option("--ridges", height) + (are_kept ? " --keep-ridges" : "");
}

std::optional<RidgeGoals> RidgeArguments::goals() const {
  if (!height) return std::nullopt;
  return RidgeGoals{*parse_non_negative("--ridges", *height), are_kept};
}

Json describe_ridges(const RidgeArguments& given, const std::optional<Ridges>& ridges) {
  if (!ridges) return nullptr;
  return Json{{"height", *parse_non_negative("--ridges", *given.height)},
              {"kept", given.are_kept},
              {"ridges", ridges->ridges.size()},
              {"valleys", ridges->valleys.size()},
              {"line_vertices", ridges->vertices}};
}

std::string ridges_line(const std::optional<Ridges>& ridges) {
  if (!ridges) return "";
  return summary_line("ridges",
                      fmt::format("{}, {}, {} vertices in all", format_plural(ridges->ridges.size(), "ridge"),
                                  format_plural(ridges->valleys.size(), "valley"), format_count(ridges->vertices)));
}

void warn_of_missing_ridges(const RidgeArguments& given, const std::optional<Ridges>& ridges,
                            std::vector<std::string>& warnings) {
  if (!ridges || !ridges->ridges.empty() || !ridges->valleys.empty()) return;
  warnings.push_back(
      fmt::format("--ridges {}: no ridge or valley was found; give how far the land falls or rises from one on both "
                  "sides, at least",
                  *given.height));
}

}  // namespace scarp::cli
