#include "session/options/ridge_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"

namespace scarp::cli {

void RidgeArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kRidges, height);
  add_flag(command, OptionId::kKeepRidges, are_kept);
}

Result<void> RidgeArguments::check(bool has_error) const {
  if (are_kept && !height) return fail(ErrorKind::kUsage, "--keep-ridges needs --ridges: there are none without");
  if (!height) return {};
  SCARP_TRY(const double above, parse_non_negative("--ridges", *height));
  if (above == 0) return fail(ErrorKind::kUsage, "--ridges 0 would make a ridge of all noise: it must be above 0");
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

}  // namespace scarp::cli
