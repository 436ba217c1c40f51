#include "session/options/region_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
  SCARP_TRY(auto&& tolerance,
            parse_length(fmt::format("{} {}: the error", kRoi, shell_word(text)), text.substr(at + 1)));
  return RegionFile{text.substr(0, at), std::move(tolerance)};
}

Result<RegionFile> settle_region(const std::string& text, const RasterInfo& heights,
                                 std::vector<std::string>& warnings) {
  SCARP_TRY(auto&& region, parse_region(text));
  std::vector<std::string> known;
  SCARP_RETURN_IF_ERROR(settle_goal(kRoi, heights, region.tolerance, known));
  for (const std::string& warning : known) {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  }
  return std::move(region);
}

Result<double> read_falloff(const GivenOptions& given, bool has_metres) {
  if (!given.has(kFalloff)) return 0.0;
  SCARP_TRY(const auto& length, parse_length(name_of(kFalloff), *given[kFalloff]));
  const auto metres = metres_of(length);
  if (metres && !has_metres)
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is a length, and the unit of x and y is unknown: give a number in that unit",
                            kFalloff, *given[kFalloff]));
  return metres.value_or(length.value);
}

Result<void> check_regions(const GivenOptions& given) {
  for (const std::string& text : given.all(kRoi)) {
    SCARP_RETURN_IF_ERROR(parse_region(text));
  }
  SCARP_RETURN_IF_ERROR(read_falloff(given, true));
  return {};
}

}  // namespace scarp::cli
