#include "session/options/zone_options.h"

#include <fmt/format.h>

#include "session/table/format_words.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
void ZoneArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kMaterials, materials);
  add_option(command, OptionId::kMaterialField, field);
  add_option(command, OptionId::kNodeStrings, strings);
}

const char* ZoneArguments::find_lines() const {
  if (materials) return "--materials";
  return strings.empty() ? nullptr : "--node-strings";
}

Result<void> ZoneArguments::check(const OutputFormat& format) const {
  if (field && !materials) return fail(ErrorKind::kUsage, "--material-field needs polygons: --materials FILE");
  const char* option = find_lines();
  if (option == nullptr || format.holds_zones()) return {};
  const auto holds_zones = [](const MeshFormatTraits& traits) { return traits.holds_zones; };
  return fail(ErrorKind::kUsage, fmt::format("{} is for flow models, and {} has no place for it: choose {}", option,
                                             format.title(), list_mesh_endings(holds_zones)));
}

std::string ZoneArguments::canonical() const {
  std::string text = canonical_option("--materials", materials ? Given(base_name(*materials)) : materials) +
                     canonical_option("--material-field", field);
  for (const std::string& file : strings) text += " --node-strings " + shell_word(base_name(file));
  return text;
}

}  // namespace scarp::cli
