// Rasters, regions and scripts next to INPUT, as options name them.
#pragma once

#include <string>
#include <vector>

#include "scarp/result.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct CompanionArguments {
  Given mask, tolerance, script, falloff;
  std::vector<std::string> roi;  ///< FILE[:LAYER]=M

  void add_to(CLI::App& command);
  /// Refuses what contradicts each other. `bound_option`: the command's own for a bound of all samples; `has_bound`:
  /// whether it was given.
  Result<void> check(const char* bound_option, bool has_bound) const;
  /// The option that gives samples bounds of their own, other than weights; null if there is none.
  const char* find_tolerance() const;
  /// True if samples are given weights or bounds of their own.
  bool gives_bounds() const { return mask || script || find_tolerance() != nullptr; }
  std::string canonical() const;
};

/// A region of interest, as --roi names it.
struct RegionFile {
  std::string path;  ///< with the layer
  double tolerance;
};

/// FILE[:LAYER]=M. Fails with kUsage.
Result<RegionFile> parse_region(const std::string& text);

}  // namespace scarp::cli
