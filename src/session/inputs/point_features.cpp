#include "session/inputs/point_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "io/commands.h"
#include "scarp/features.h"
#include "scarp/io.h"
#include "scarp/lines.h"
#include "session/inputs/companions.h"
#include "session/options/region_options.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Lines in the coordinates of the points.
Result<std::vector<Line>> read(const std::vector<std::string>& files, ReadLinesOptions options, PointSet& points) {
  options.crs = points.is_local ? points.source_crs : points.crs;
  options.unit_in_metres = points.heights.crs_unit_in_metres;
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

/// Warns of lines that are not at the points: too far above them, below them or away from them.
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

/// Warns of places with two heights, where the point's height counts.
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

/// Lowers tolerances to the raster's value at the point. Pixels without a value and places outside the raster have
/// none. False if it lowers no tolerance.
Result<bool> lower_by_raster(const std::string& path, PointSet& points, const ProgressCallback& progress,
                             std::vector<float>& tolerances) {
  ReadOptions options;
  options.crs = "grid";
  options.as_values = true;
  options.run.progress = progress;
  Result<OwnedHeightField> values = read_height_field(path, options);
  if (!values) return fail(values.error().kind, fmt::format("{}: {}", kTolerance, values.error().message));
  points.warnings.insert(points.warnings.end(), values->info.warnings.begin(), values->info.warnings.end());
  const std::string& crs = points.is_local ? points.source_crs : points.crs;
  if (!crs.empty() && !values->info.crs.empty() && crs != values->info.crs)
    return fail(ErrorKind::kInput,
                fmt::format("{} {} is in {}, and the points are read in {}: bring it there (gdalwarp -t_srs {} {} {})",
                            kTolerance, shell_word(path), values->info.crs, crs, shell_word(crs), shell_word(path),
                            io::new_file(".tif")));
  const std::array<double, 6>& g = values->info.geotransform;
  const double area = g[1] * g[5] - g[2] * g[4];
  if (!values->info.has_georeference || area == 0)
    return fail(ErrorKind::kInput, fmt::format("{} {} has no place: points need a raster in their coordinates",
                                               kTolerance, shell_word(path)));
  const double scale = units_of(values->info, points.heights);
  bool lowers_any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points.place_in_file(i);
    const double col = ((x - g[0]) * g[5] - (y - g[3]) * g[2]) / area;
    const double row = ((y - g[3]) * g[1] - (x - g[0]) * g[4]) / area;
    if (!(col >= 0 && col <= values->cols && row >= 0 && row <= values->rows)) continue;
    // The far sides belong to the last pixels.
    const auto c = std::min(static_cast<int>(col), values->cols - 1),
               r = std::min(static_cast<int>(row), values->rows - 1);
    const double value = double{values->samples[static_cast<std::size_t>(r) * values->cols + c]} * scale;
    if (value < 0)
      return fail(ErrorKind::kInput, fmt::format("{} {}: the tolerance {} in column {}, row {} is negative", kTolerance,
                                                 shell_word(path), value, c, r));
    if (std::isnan(value) || !(value < double{tolerances[i]})) continue;
    const auto rounded = static_cast<float>(value);
    tolerances[i] = double{rounded} > value ? std::nextafter(rounded, 0.0f) : rounded;
    lowers_any = true;
  }
  return lowers_any;
}

}  // namespace

Result<void> add_breaklines(const GivenOptions& given, DuplicatePolicy duplicates, const ProgressCallback& progress,
                            PointSet& points) {
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
  SCARP_TRY(const auto beyond, add_lines(lines, points, duplicates));
  if (beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie beyond the points: they have the height of the nearest place on the points' hull",
                    format_plural(beyond, "place"), kBreaklines));
  return {};
}

namespace {

Result<std::vector<Line>> read_lakes(const GivenOptions& given, const ProgressCallback& progress, PointSet& points) {
  ReadLinesOptions options;
  options.ignore_z = true;
  options.progress = progress;
  SCARP_TRY(const auto& rings, read(given.all(kWater), options, points));
  SCARP_RETURN_IF_ERROR(check_polygons(rings, name_of(kWater), name_of(kBreaklines)));
  return inset_polygons(rings, 0);
}

}  // namespace

Result<std::vector<PointLake>> add_lakes(const GivenOptions& given, DuplicatePolicy duplicates,
                                         const ProgressCallback& progress, PointSet& points) {
  if (given.all(kWater).empty()) return std::vector<PointLake>();
  SCARP_TRY(const auto& rings, read_lakes(given, progress, points));
  const double percentile = given.number(kWaterPercentile)->value_or(WaterOptions().percentile);
  SCARP_TRY(auto&& lakes, level_lakes(rings, percentile, points, duplicates));
  const auto far =
      std::count_if(lakes.begin(), lakes.end(), [](const PointLake& lake) { return std::isnan(lake.level); });
  if (far > 0)
    points.warnings.push_back(fmt::format("{} of {} beyond the points: {}", format_plural(far, "lake"), kWater,
                                          std::cmp_equal(far, lakes.size()) ? "it changes nothing" : "omitted"));
  std::uint64_t beyond = 0;
  for (const PointLake& lake : lakes) beyond += std::isnan(lake.level) ? 0 : lake.beyond;
  if (beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie beyond the points: the mesh reaches there", format_plural(beyond, "place"), kWater));
  return std::move(lakes);
}

Result<void> drop_lakes(const GivenOptions& given, const ProgressCallback& progress, PointSet& points) {
  if (given.all(kWater).empty()) return {};
  SCARP_TRY(const auto& rings, read_lakes(given, progress, points));
  drop_inside(rings, points);
  return {};
}

Result<std::vector<float>> read_tolerances(const GivenOptions& given, double beyond, const ProgressCallback& progress,
                                           PointSet& points) {
  if (!find_tolerance(given)) return std::vector<float>();
  ReadLinesOptions options;
  options.ignore_z = true;
  options.progress = progress;
  std::vector<Region> regions;
  for (const std::string& text : given.all(kRoi)) {
    SCARP_TRY(const RegionFile& file, settle_region(text, points.heights, points.warnings));
    SCARP_TRY(auto&& lines, read({file.path}, options, points));
    regions.push_back({std::move(lines), file.tolerance.value});
  }
  const bool has_metres = points.unit_in_metres > 0;
  SCARP_TRY(const double falloff, read_falloff(given, has_metres));
  std::vector<bool> found;
  auto tolerances =
      region_tolerances(regions, points, falloff / (has_metres ? points.unit_in_metres : 1), beyond, &found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k])
      points.warnings.push_back(
          fmt::format("{} {} lowers the error of no point: none lies in it (are both in one CRS?), or its "
                      "error is not below that of the others",
                      kRoi, shell_word(given.all(kRoi)[k])));
  }
  for (std::size_t i = 0; i < points.tolerances.size(); ++i)
    tolerances[i] = std::min(tolerances[i], points.tolerances[i]);
  if (given.has(kTolerance) && points.tolerances.empty()) {
    SCARP_TRY(const auto found_any, lower_by_raster(*given[kTolerance], points, progress, tolerances));
    if (!found_any)
      points.warnings.push_back(fmt::format("{} {} lowers the error of no point: it changes nothing", kTolerance,
                                            shell_word(*given[kTolerance])));
  }
  return tolerances;
}

Result<std::vector<Line>> read_boundary(const GivenOptions& given, OptionId called, const ProgressCallback& progress,
                                        PointSet& points) {
  SCARP_TRY(const auto& boundary, parse_boundary(given));
  if (boundary.file.empty()) return std::vector<Line>();
  ReadLinesOptions options;
  options.ignore_z = true;
  options.progress = progress;
  SCARP_TRY(const auto& rings, read({boundary.file}, options, points));
  SCARP_RETURN_IF_ERROR(check_polygons(rings, name_of(called), name_of(kBreaklines)));
  return inset_polygons(rings, 0);
}

Result<std::optional<BoundaryCut>> cut_to_boundary(const GivenOptions& given, OptionId called,
                                                   DuplicatePolicy duplicates, double tolerance,
                                                   const ProgressCallback& progress, PointSet& points) {
  SCARP_TRY(const auto& rings, read_boundary(given, called, progress, points));
  if (rings.empty()) return std::nullopt;
  const std::uint64_t given_points = points.size();
  SCARP_TRY(const auto& cut, scarp::cut_to_boundary(rings, tolerance, points, duplicates));
  if (cut.points_outside >= given_points)
    return fail(ErrorKind::kInput,
                fmt::format("no point lies within {} {}: are both in one CRS?", called, shell_word(*given[kBoundary])));
  if (cut.corners_beyond > 0)
    points.warnings.push_back(
        fmt::format("{} of {} lie up to {:.6g} beyond the points, where heights are those of the "
                    "nearest place on the points' hull",
                    format_plural(cut.corners_beyond, "corner"), called, cut.farthest));
  return cut;
}

}  // namespace scarp::cli
