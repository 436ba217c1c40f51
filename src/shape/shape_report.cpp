#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "shape/shape_refinement.h"

namespace scarp {

ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, std::uint64_t forced) {
  constexpr double kBin = 5;
  ShapeReport report;
  report.min_angle = 60;
  std::vector<std::array<std::uint32_t, 2>> shorter;  // twice, where two triangles share them
  report.shortest_edge = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::array<double, 2>, 3> edges;  // each opposite a corner
    std::array<double, 3> lengths;
    for (std::size_t k = 0; k < 3; ++k) {
      const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + (k + 1) % 3]}];
      const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + (k + 2) % 3]}];
      edges[k] = {b[0] - a[0], b[1] - a[1]};
      lengths[k] = std::hypot(edges[k][0], edges[k][1]);
    }
    const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
    report.shortest_edge = std::min(report.shortest_edge, *shortest);
    report.longest_edge = std::max(report.longest_edge, *longest);
    const auto k = static_cast<std::size_t>(shortest - lengths.begin());
    const auto &u = edges[(k + 1) % 3], &v = edges[(k + 2) % 3];
    const double angle =
        std::atan2(std::abs(u[0] * v[1] - u[1] * v[0]), -u[0] * v[0] - u[1] * v[1]) * (180 / std::numbers::pi);
    report.min_angle = std::min(report.min_angle, angle);
    for (std::size_t k = 0; k < 3 && goals.min_edge; ++k) {
      const std::uint32_t a = mesh.triangles[3 * t + (k + 1) % 3], b = mesh.triangles[3 * t + (k + 2) % 3];
      if (lengths[k] < *goals.min_edge) shorter.push_back({std::min(a, b), std::max(a, b)});
    }
    report.below += angle < goals.min_angle;
    ++report.histogram[std::min(static_cast<std::size_t>(angle / kBin), report.histogram.size() - 1)];
  }
  std::sort(shorter.begin(), shorter.end());
  report.shorter = static_cast<std::uint64_t>(std::unique(shorter.begin(), shorter.end()) - shorter.begin());
  report.forced = std::min(forced, report.below);
  return report;
}

}  // namespace scarp
