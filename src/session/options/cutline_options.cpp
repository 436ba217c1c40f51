#include "session/options/cutline_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
void CutlineArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kCutline, files);
  add_option(command, OptionId::kInset, inset);
  add_flag(command, OptionId::kMaskOutside, mask_outside);
}

Result<void> CutlineArguments::check() const {
  const char* needing = inset ? "--inset" : mask_outside ? "--mask-outside" : nullptr;
  if (needing != nullptr && files.empty())
    return fail(ErrorKind::kUsage, fmt::format("{} needs --cutline: there is no polygon without", needing));
  if (!inset) return {};
  const Result<double> distance = parse_number("--inset", *inset);
  return distance ? Result<void>() : tl::unexpected(distance.error());
}

std::string CutlineArguments::canonical() const {
  std::string text;
  for (const std::string& file : files) text += " --cutline " + shell_word(base_name(file));
  return text + canonical_option("--inset", inset) + (mask_outside ? " --mask-outside" : "");
}

}  // namespace scarp::cli
