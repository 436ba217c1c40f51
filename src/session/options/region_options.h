// Options that set individual weights or bounds of samples.
#pragma once

#include <string>

#include "session/options/error_goal.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The first option given that sets individual bounds other than weights, if any.
std::optional<OptionId> find_tolerance(const GivenOptions& given);
/// True if samples have individual weights or bounds.
bool gives_bounds(const GivenOptions& given);

/// A region of interest of --roi.
struct RegionFile {
  std::string path;  ///< includes the layer
  ErrorGoal tolerance;
};

/// Parses FILE[:LAYER]=M. Fails with kUsage.
Result<RegionFile> parse_region(const std::string& text);
/// Like parse_region(), with M in the unit of the heights. Fails and warns like settle_goal().
Result<RegionFile> settle_region(const std::string& text, const RasterInfo& heights,
                                 std::vector<std::string>& warnings);
/// The falloff; 0: none. In metres if the unit of x and y has a known length (`has_metres`), else in that unit. kUsage
/// for a falloff with a unit if the length is unknown.
Result<double> read_falloff(const GivenOptions& given, bool has_metres);
/// Fails with kUsage for an invalid region or falloff.
Result<void> check_regions(const GivenOptions& given);

}  // namespace scarp::cli
