#include "session/options/zone_options.h"

#include <fmt/format.h>

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
  if (option == nullptr || format.is_2dm()) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} is for 2DM, and OUTPUT is {}, which has no place for it: choose .2dm",
                                             option, format.title()));
}

std::string ZoneArguments::canonical() const {
  std::string text = canonical_option("--materials", materials ? Given(base_name(*materials)) : materials) +
                     canonical_option("--material-field", field);
  for (const std::string& file : strings) text += " --node-strings " + shell_word(base_name(file));
  return text;
}

}  // namespace scarp::cli
