#include "session/options/region_options.h"

#include <fmt/format.h>

#include "session/text/text.h"

namespace scarp::cli {
namespace {
using enum OptionId;
}

std::optional<OptionId> find_tolerance(const GivenOptions& given) { return given.first_of({kTolerance, kRoi}); }

bool gives_bounds(const GivenOptions& given) { return given.first_of({kMask, kScript, kTolerance, kRoi}).has_value(); }

Result<RegionFile> parse_region(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0)
    return fail(ErrorKind::kUsage, fmt::format("{} {}: behind the file an error is missing, such as {}=0.2", kRoi,
                                               shell_word(text), text));
  SCARP_TRY(const double tolerance,
            parse_non_negative(fmt::format("{} {}: the error", kRoi, shell_word(text)), text.substr(at + 1)));
  return RegionFile{text.substr(0, at), tolerance};
}

Result<void> check_regions(const GivenOptions& given) {
  for (const std::string& text : given.all(kRoi)) {
    SCARP_RETURN_IF_ERROR(parse_region(text));
  }
  SCARP_RETURN_IF_ERROR(given.number(kFalloff));
  return {};
}

}  // namespace scarp::cli
