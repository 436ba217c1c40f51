// Options that give samples weights or bounds of their own.
#pragma once

#include <string>

#include "session/options/given_options.h"

namespace scarp::cli {

/// The option that gives samples bounds of their own, other than weights; nothing if there is none.
std::optional<OptionId> find_tolerance(const GivenOptions& given);
/// True if samples are given weights or bounds of their own.
bool gives_bounds(const GivenOptions& given);

/// A region of interest, as --roi names it.
struct RegionFile {
  std::string path;  ///< with the layer
  double tolerance;
};

/// FILE[:LAYER]=M. Fails with kUsage.
Result<RegionFile> parse_region(const std::string& text);
/// Fails with kUsage for a region or a falloff that is none.
Result<void> check_regions(const GivenOptions& given);

}  // namespace scarp::cli
