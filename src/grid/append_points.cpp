#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scarp/points.h"

namespace scarp {

namespace {

void append(const std::vector<double>& more, std::vector<double>& values) {
  values.insert(values.end(), more.begin(), more.end());
}

void add_facts(const LasFacts& more, LasFacts& las) {
  las.points += more.points;
  las.withheld += more.withheld;
  las.of_other_classes += more.of_other_classes;
  las.overlap += more.overlap;
  las.of_other_returns += more.of_other_returns;
  for (const PointClass& of : more.classes) {
    const auto at = std::lower_bound(las.classes.begin(), las.classes.end(), of.number,
                                     [](const PointClass& held, int number) { return held.number < number; });
    if (at != las.classes.end() && at->number == of.number) {
      at->points += of.points;
    } else {
      las.classes.insert(at, of);
    }
  }
}

std::string words_of(const std::string& value) { return value.empty() ? "none" : value; }

}  // namespace

Result<void> append_points(const PointSet& more, PointSet& points) {
  const auto differ = [&](const char* what, const std::string& one, const std::string& other, const char* advice) {
    return fail(ErrorKind::kInput, fmt::format("{} has another {} than {}: {} and {}; {}", more.path, what, points.path,
                                               words_of(one), words_of(other), advice));
  };
  if (points.is_local || more.is_local)
    return fail(ErrorKind::kInput, fmt::format("{} and {} would each have a local frame of its own: name one CRS for "
                                               "both, such as EPSG:32633, or give them in one file",
                                               points.path, more.path));
  if (more.crs != points.crs)
    return differ("CRS", more.crs, points.crs,
                  more.crs.empty() || points.crs.empty() ? "declare the CRS of both" : "name one CRS for both");
  if (more.heights.unit != points.heights.unit || more.heights.z_scale != points.heights.z_scale)
    return differ("unit of heights", more.heights.unit, points.heights.unit, "name the unit of both");
  if (!more.boundary.empty() || !points.boundary.empty())
    return fail(ErrorKind::kUsage, "points with a boundary cannot be joined: cut them to it afterwards");
  const auto first = static_cast<std::uint32_t>(points.size());
  if (!more.tolerances.empty()) {
    points.tolerances.resize(first, std::numeric_limits<float>::infinity());
    points.tolerances.insert(points.tolerances.end(), more.tolerances.begin(), more.tolerances.end());
  }
  append(more.x, points.x);
  append(more.y, points.y);
  append(more.z, points.z);
  for (PointLine line : more.lines) {
    for (std::uint32_t& point : line.points) point += first;
    points.lines.push_back(std::move(line));
  }
  points.outlines.insert(points.outlines.end(), more.outlines.begin(), more.outlines.end());
  points.without_height += more.without_height;
  points.spikes += more.spikes;
  points.outside += more.outside;
  if (points.las && more.las) add_facts(*more.las, *points.las);
  for (const std::string& warning : more.warnings) {
    if (std::find(points.warnings.begin(), points.warnings.end(), warning) == points.warnings.end())
      points.warnings.push_back(warning);
  }
  return {};
}

}  // namespace scarp
