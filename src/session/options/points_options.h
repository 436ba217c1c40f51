// The options of every command that reads scattered points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// True if the input is to be read as points: it was asked for, or its name shows it.
bool are_points_meant(const GivenOptions& given);
/// Fails if one of several inputs holds points, which make no mosaic, or if an option was given that does not hold for
/// the input, points or raster: silence would be a lie.
Result<void> check_kind_of_input(const GivenOptions& given);

/// read_points() as the options ask: --layer, --z-field, --columns, --class, --returns, and the reading of a raster,
/// `as`. Fails with kUsage for what cannot be parsed.
Result<ReadPointsOptions> parse_points(const GivenOptions& given, const ReadOptions& as);

/// The points of all inputs as one set, with a warning of boundaries in them unless --boundary is given. Fails as
/// read_points() and append_points() do.
Result<PointSet> read_inputs(const GivenOptions& given, const ReadPointsOptions& options);

/// --duplicates. Fails with kUsage.
Result<DuplicatePolicy> parse_policy(const GivenOptions& given);
const char* policy_name(DuplicatePolicy policy);
/// --boundary.
struct BoundaryChoice {
  std::optional<double> length;  ///< LENGTH of concave:LENGTH
  std::string file;              ///< file of polygons; neither: the convex hull
};
Result<BoundaryChoice> parse_boundary(const GivenOptions& given);

}  // namespace scarp::cli
