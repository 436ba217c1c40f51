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

/// True if the input is to be read as points: by --points, or by its name.
bool are_points_meant(const GivenOptions& given);
/// Fails if one of several inputs holds points, which cannot form a mosaic. Also fails for an option that has no effect
/// on this kind of input, points or raster.
Result<void> check_kind_of_input(const GivenOptions& given);

/// The options of read_points(), from --layer, --z-field, --columns, --class and --returns, and from `as`, the options
/// of a raster. Fails with kUsage for an invalid value.
Result<ReadPointsOptions> parse_points(const GivenOptions& given, const ReadOptions& as);

/// Adds the number of other files to the path of the first of `files`.
void name_others(std::size_t files, PointSet& points);

/// The points of all inputs as one set. Without --boundary, warns of boundaries in the inputs. Fails if read_points()
/// or append_points() fails.
Result<PointSet> read_inputs(const GivenOptions& given, const ReadPointsOptions& options);

/// --duplicates. Fails with kUsage.
Result<DuplicatePolicy> parse_policy(const GivenOptions& given);
const char* policy_name(DuplicatePolicy policy);
/// --boundary.
struct BoundaryChoice {
  std::optional<double> length;  ///< LENGTH of concave:LENGTH
  std::string file;              ///< file of polygons; without both: the convex hull
};
Result<BoundaryChoice> parse_boundary(const GivenOptions& given);

}  // namespace scarp::cli
