#include "options/ridge_options.h"

#include <fmt/format.h>

#include <utility>

#include "commands/simplify_run.h"
#include "options/memory.h"
#include "options/option_table.h"
#include "reports/report.h"
#include "terminal/text.h"

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

Result<std::optional<Ridges>> RidgeArguments::add_ridges(const HeightField& field, double max_error, int threads,
                                                         const MemoryShare& memory, const ProgressCallback& progress,
                                                         LineConstraints& lines) const {
  if (!height) return std::nullopt;
  RidgeOptions options;
  options.height = *parse_non_negative("--ridges", *height);
  options.max_error = max_error;
  options.affine = lines.affine;
  options.avoid = lines.lines;
  options.are_kept = are_kept;
  options.threads = threads;
  options.progress = progress;
  options.memory_limit = memory.limit;
  options.memory_taken = memory.taken;
  auto ridges = detect_ridges(field, options);
  if (!ridges) return tl::unexpected(std::move(ridges.error()));
  for (const auto* found : {&ridges->ridges, &ridges->valleys})
    lines.lines.insert(lines.lines.end(), found->begin(), found->end());
  return std::optional<Ridges>(std::move(*ridges));
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

}  // namespace scarp::cli
