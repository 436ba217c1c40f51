#include "session/inputs/point_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "scarp/lines.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Lines in the coordinates of the points.
Result<std::vector<Line>> read(const std::vector<std::string>& files, ReadLinesOptions options, PointSet& points) {
  options.crs = points.is_local ? points.source_crs : points.crs;
  SCARP_TRY(auto&& set, read_lines(files, options, points.heights));
  const auto& [west, across, unused, south, unused_too, up] = points.to_source;
  for (Line& line : set.lines) {
    for (auto& point : line.points) {
      point[0] = (point[0] - west) / across;
      point[1] = (point[1] - south) / up;
    }
  }
  points.warnings.insert(points.warnings.end(), set.warnings.begin(), set.warnings.end());
  return std::move(set.lines);
}

/// Warns of lines that lie elsewhere than the points, above each other or next to them.
void warn_of_strangers(const std::vector<Line>& lines, PointSet& points) {
  const auto reach_of = [](const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double size = *most - *least;
    return std::pair{*least - size, *most + size};
  };
  const auto x = reach_of(points.x), y = reach_of(points.y), z = reach_of(points.z);
  const auto lies_in = [](const auto& reach, double value) { return reach.first <= value && value <= reach.second; };
  std::uint64_t far = 0, high = 0;
  for (const Line& line : lines) {
    for (const auto& point : line.points) {
      if (!lies_in(x, point[0]) || !lies_in(y, point[1])) ++far;
      if (!std::isnan(point[2]) && !lies_in(z, point[2])) ++high;
    }
  }
  if (far > 0)
    points.warnings.push_back(fmt::format("{} of {} lie far from all points: are both in one CRS?",
                                          format_plural(far, "place"), kBreaklines));
  if (high > 0)
    points.warnings.push_back(
        fmt::format("{} of {} have heights far from those of the points: {} ...,soft uses the "
                    "heights of the points",
                    format_plural(high, "place"), kBreaklines, kBreaklines));
}

/// Warns of places with two heights: that of the point counts.
void warn_of_two_heights(const std::vector<Line>& lines, PointSet& points) {
  std::map<std::pair<double, double>, double> heights;
  for (const Line& line : lines) {
    for (const auto& [x, y, z] : line.points) {
      if (!std::isnan(z)) heights[{x, y}] = z;
    }
  }
  std::uint64_t count = 0;
  double most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto found = heights.find({points.x[i], points.y[i]});
    if (found == heights.end() || found->second == points.z[i]) continue;
    ++count;
    most = std::max(most, std::abs(found->second - points.z[i]));
  }
  if (count > 0)
    points.warnings.push_back(
        fmt::format("{} of {} have a point at the same x and y, up to {:.6g} above or below: the "
                    "height of the point counts",
                    format_plural(count, "place"), kBreaklines, most));
}

}  // namespace

Result<void> add_breaklines(const GivenOptions& given, const ProgressCallback& progress, PointSet& points) {
  const auto files = given.all(kBreaklines);
  if (files.empty()) return {};
  ReadLinesOptions options;
  options.z_field = given[kBreaklineZ].value_or("");
  options.ignore_z = given.has(kSoftBreaklines);
  options.progress = progress;
  SCARP_TRY(auto&& lines, read(files, options, points));
  for (Line& line : lines) {
    for (auto& point : line.points) point[2] = points.heights.z_scale * point[2] + points.heights.z_offset;
  }
  warn_of_strangers(lines, points);
  warn_of_two_heights(lines, points);
  SCARP_TRY(const auto beyond, add_lines(lines, points));
  if (beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie beyond the points: they have the height of the nearest place on the points' hull",
                    format_plural(beyond, "place"), kBreaklines));
  return {};
}

Result<std::vector<Line>> read_boundary(const GivenOptions& given, const ProgressCallback& progress, PointSet& points) {
  SCARP_TRY(const auto& boundary, parse_boundary(given));
  if (boundary.file.empty()) return std::vector<Line>();
  ReadLinesOptions options;
  options.ignore_z = true;
  options.progress = progress;
  SCARP_TRY(const auto& rings, read({boundary.file}, options, points));
  SCARP_RETURN_IF_ERROR(check_polygons(rings, name_of(kBoundary), name_of(kBreaklines)));
  return inset_polygons(rings, 0);
}

Result<std::optional<BoundaryCut>> cut_to_boundary(const GivenOptions& given, double tolerance,
                                                   const ProgressCallback& progress, PointSet& points) {
  SCARP_TRY(const auto& rings, read_boundary(given, progress, points));
  if (rings.empty()) return std::nullopt;
  const std::uint64_t given_points = points.size();
  SCARP_TRY(const auto& cut, scarp::cut_to_boundary(rings, tolerance, points));
  if (cut.points_outside >= given_points)
    return fail(ErrorKind::kInput, fmt::format("no point lies within {} {}: are both in one CRS?", kBoundary,
                                               shell_word(*given[kBoundary])));
  if (cut.corners_beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie up to {:.6g} beyond the points, where heights are those of the "
                    "nearest place on the points' hull",
                    format_plural(cut.corners_beyond, "corner"), kBoundary, cut.farthest));
  return cut;
}

}  // namespace scarp::cli
