#include "session/options/cliff_options.h"

#include <fmt/format.h>

#include <utility>

#include "session/inputs/memory.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

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

std::optional<WallGoals> CliffArguments::goals() const {
  if (!height) return std::nullopt;
  return WallGoals{*parse_non_negative("--cliff", *height)};
}

Json describe_cliffs(const CliffArguments& given, const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return nullptr;
  return Json{{"height", *parse_non_negative("--cliff", *given.height)},
              {"walls", cliffs->wall_count},
              {"lines", cliffs->lines.size()},
              {"line_vertices", cliffs->vertices}};
}

std::string cliffs_line(const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return "";
  return summary_line("cliffs",
                      fmt::format("{} ({})", format_plural(cliffs->wall_count, "wall"),
                                  cliffs->vertices == 1 ? "1 vertex" : format_count(cliffs->vertices) + " vertices"));
}

void warn_of_missing_walls(const CliffArguments& given, const std::optional<Cliffs>& cliffs,
                           std::vector<std::string>& warnings) {
  if (!cliffs || cliffs->wall_count > 0) return;
  warnings.push_back(fmt::format(
      "--cliff {}: no wall was found; give the least height of one, the difference of two neighbouring samples",
      *given.height));
}

}  // namespace scarp::cli
