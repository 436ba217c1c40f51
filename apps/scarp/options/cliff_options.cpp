#include "options/cliff_options.h"

#include <fmt/format.h>

#include <utility>

#include "commands/simplify_run.h"
#include "options/memory.h"
#include "options/option_table.h"
#include "reports/report.h"
#include "terminal/text.h"

namespace scarp::cli {

void CliffArguments::add_to(CLI::App& command) { add_option(command, OptionId::kCliff, height); }

Result<void> CliffArguments::check(bool has_error) const {
  if (!height) return {};
  const Result<double> above = parse_non_negative("--cliff", *height);
  if (!above) return tl::unexpected(above.error());
  if (*above == 0) return fail(ErrorKind::kUsage, "--cliff 0 would make a wall of every step: it must be above 0");
  if (!has_error)
    return fail(ErrorKind::kUsage, "--cliff needs --max-error, or a budget: walls are fitted to one bound");
  return {};
}

Result<std::optional<Cliffs>> CliffArguments::add_cliffs(const HeightField& field, double max_error,
                                                         const MemoryShare& memory, LineConstraints& lines) const {
  if (!height) return std::nullopt;
  CliffOptions options;
  options.height = *parse_non_negative("--cliff", *height);
  options.max_error = max_error;
  options.affine = lines.affine;
  options.avoid = lines.lines;
  options.memory_limit = memory.limit;
  options.memory_taken = memory.taken;
  auto cliffs = detect_cliffs(field, options);
  if (!cliffs) return tl::unexpected(std::move(cliffs.error()));
  lines.lines.insert(lines.lines.end(), cliffs->lines.begin(), cliffs->lines.end());
  return std::optional<Cliffs>(std::move(*cliffs));
}

Json describe_cliffs(const CliffArguments& given, const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return nullptr;
  return Json{{"height", *parse_non_negative("--cliff", *given.height)},
              {"walls", cliffs->faults},
              {"lines", cliffs->lines.size()},
              {"line_vertices", cliffs->vertices}};
}

std::string cliffs_line(const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return "";
  return summary_line("cliffs", fmt::format("{} between two lines each, {}", format_plural(cliffs->faults, "wall"),
                                            format_count(cliffs->vertices) + " vertices in all"));
}

}  // namespace scarp::cli
