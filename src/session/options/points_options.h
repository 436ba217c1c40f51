// The options of every command that reads scattered points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/point_set.h"
#include "scarp/result.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct PointsArguments {
  bool points = false;
  Given duplicates, layer, z_field, columns, boundary;

  void add_to(CLI::App& command);
  /// True if the input is to be read as points: it was asked for, or its name shows it.
  bool are_meant(const std::string& path) const { return points || columns || is_point_file(path); }
  /// Fails if one of several inputs holds points, which make no mosaic.
  Result<void> check_single(const std::vector<std::string>& paths) const;
  /// Those that were given, for the canonical command.
  std::string canonical() const;
  /// Fails if an option for points was given, for an input that is a raster.
  Result<void> check_unused(const std::string& path) const;
};

/// --duplicates. Fails with kUsage.
Result<DuplicatePolicy> parse_policy(const Given& text);
const char* policy_name(DuplicatePolicy policy);
/// The LENGTH of --boundary concave:LENGTH; nothing for the convex hull.
Result<std::optional<double>> parse_boundary(const Given& text);

/// Fails if an option was given that is for rasters: silence would be a lie.
Result<void> refuse_raster_options(const CLI::App& command, const std::string& path);

}  // namespace scarp::cli
