// The options for scattered points.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "commands/points_command.h"
#include "terminal/text.h"

namespace scarp::cli {

void PointsArguments::add_to(CLI::App& verb) {
  constexpr const char* kGroup = "Scattered points (.csv .xyz .gpkg .geojson .shp ...)";
  verb.add_flag("--points", points, "INPUT is points, whatever its name ends in")->group(kGroup);
  verb.add_option("--duplicates", duplicates,
                  "Of several points at one place take the first\n(default), last, highest, lowest or their mean")
      ->type_name("POLICY")
      ->group(kGroup);
  verb.add_option("--layer", layer, "Layer to read (default: the first one with points)")
      ->type_name("NAME")
      ->group(kGroup);
  verb.add_option("--z-field", z_field,
                  "Column or attribute with the heights (default: the\nthird coordinate, else z, height, elevation, "
                  "elev, h)")
      ->type_name("NAME")
      ->group(kGroup);
}

Result<void> PointsArguments::check_unused(const std::string& path) const {
  const std::pair<const char*, bool> options[] = {
      {"--duplicates", duplicates.has_value()}, {"--layer", layer.has_value()}, {"--z-field", z_field.has_value()}};
  for (const auto& [name, is_given] : options) {
    if (is_given)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for scattered points, and {} is taken for a raster: --points says otherwise", name,
                              shell_word(base_name(path))));
  }
  return {};
}

}  // namespace scarp::cli
