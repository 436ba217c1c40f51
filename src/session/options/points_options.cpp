// The options for scattered points.
#include <fmt/format.h>

#include "commands/points_command.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {

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

}  // namespace scarp::cli
