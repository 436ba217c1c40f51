#include "session/options/cliff_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"

namespace scarp::cli {

void CliffArguments::add_to(CLI::App& command) { add_option(command, OptionId::kCliff, height); }

Result<void> CliffArguments::check(bool has_error) const {
  if (!height) return {};
  SCARP_TRY(const double above, parse_non_negative("--cliff", *height));
  if (above == 0) return fail(ErrorKind::kUsage, "--cliff 0 would make a wall of every step: it must be above 0");
  if (!has_error)
    return fail(ErrorKind::kUsage, "--cliff needs --max-error, or a budget: walls are fitted to one bound");
  return {};
}

std::optional<WallGoals> CliffArguments::goals() const {
  if (!height) return std::nullopt;
  return WallGoals{*parse_non_negative("--cliff", *height)};
}

}  // namespace scarp::cli
