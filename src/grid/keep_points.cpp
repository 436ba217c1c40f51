#include "grid/keep_points.h"

#include <algorithm>
#include <cmath>

namespace scarp::grid {

std::vector<std::uint32_t> keep_points(PointSet& points, FunctionRef<bool(std::size_t)> stays) {
  std::vector<std::uint32_t> names(points.size(), 0);
  std::uint32_t kept = 0;
  std::size_t bounded = 0;  // remaining points with a tolerance
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!stays(i)) continue;
    points.x[kept] = points.x[i];
    points.y[kept] = points.y[i];
    points.z[kept] = points.z[i];
    if (i < points.tolerances.size()) points.tolerances[bounded++] = points.tolerances[i];
    names[i] = kept++;
  }
  for (auto* values : {&points.x, &points.y, &points.z}) values->resize(kept);
  points.tolerances.resize(bounded);
  for (PointLine& line : points.lines) {
    for (std::uint32_t& point : line.points) point = names[point];
  }
  return names;
}

bool has_finite_places(const PointSet& points) {
  const auto are_finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  return are_finite(points.x) && are_finite(points.y);
}

}  // namespace scarp::grid
