// Options that give samples individual weights or bounds.
#pragma once

#include <string>

#include "session/options/given_options.h"

namespace scarp::cli {

/// The first option given that sets individual bounds other than weights, if any.
std::optional<OptionId> find_tolerance(const GivenOptions& given);
/// True if samples have individual weights or bounds.
bool gives_bounds(const GivenOptions& given);

/// A region of interest of --roi.
struct RegionFile {
  std::string path;  ///< includes the layer
  double tolerance;
};

/// Parses FILE[:LAYER]=M. Fails with kUsage.
Result<RegionFile> parse_region(const std::string& text);
/// Fails with kUsage for an invalid region or falloff.
Result<void> check_regions(const GivenOptions& given);

}  // namespace scarp::cli
