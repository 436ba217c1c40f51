#include "session/inputs/point_features.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "scarp/lines.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

Result<std::vector<Line>> read(const std::vector<std::string>& files, OptionId option, ReadLinesOptions options,
                               PointSet& points) {
  if (points.is_local)
    return fail(ErrorKind::kUsage,
                fmt::format("{} needs points in metres or feet: {} EPSG:CODE converts degrees to a map projection",
                            option, kCrs));
  options.crs = points.crs;
  SCARP_TRY(auto&& set, read_lines(files, options, points.heights));
  points.warnings.insert(points.warnings.end(), set.warnings.begin(), set.warnings.end());
  return std::move(set.lines);
}

}  // namespace

Result<void> add_breaklines(const GivenOptions& given, const ProgressCallback& progress, PointSet& points) {
  const auto files = given.all(kBreaklines);
  if (files.empty()) return {};
  ReadLinesOptions options;
  options.z_field = given[kBreaklineZ].value_or("");
  options.ignore_z = given.has(kSoftBreaklines);
  options.progress = progress;
  SCARP_TRY(auto&& lines, read(files, kBreaklines, options, points));
  for (Line& line : lines) {
    for (auto& point : line.points) point[2] = points.heights.z_scale * point[2] + points.heights.z_offset;
  }
  SCARP_TRY(const auto beyond, add_lines(lines, points));
  if (beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie beyond the points: they have the height of the nearest place on the points' hull",
                    format_plural(beyond, "place"), kBreaklines));
  return {};
}

Result<std::optional<BoundaryCut>> cut_to_boundary(const GivenOptions& given, double tolerance,
                                                   const ProgressCallback& progress, PointSet& points) {
  SCARP_TRY(const auto& boundary, parse_boundary(given));
  if (boundary.file.empty()) return std::nullopt;
  ReadLinesOptions options;
  options.ignore_z = true;
  options.progress = progress;
  SCARP_TRY(const auto& rings, read({boundary.file}, kBoundary, options, points));
  SCARP_RETURN_IF_ERROR(check_polygons(rings, name_of(kBoundary), name_of(kBreaklines)));
  const std::uint64_t given_points = points.size();
  SCARP_TRY(const auto& cut, scarp::cut_to_boundary(rings, tolerance, points));
  if (cut.points_outside >= given_points)
    return fail(ErrorKind::kInput,
                fmt::format("no point lies within {} {}: are both in one CRS?", kBoundary, shell_word(boundary.file)));
  if (cut.corners_beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie up to {:.6g} beyond the points, where heights are those of the "
                    "nearest place on the points' hull",
                    format_plural(cut.corners_beyond, "corner"), kBoundary, cut.farthest));
  return cut;
}

}  // namespace scarp::cli
