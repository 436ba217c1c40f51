#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "shape/plan_metric.h"
#include "shape/plan_shapes.h"
#include "shape/shape_refinement.h"

namespace scarp::shape {

ShapeLosses count_losses(const tin::Triangulation& tin, std::int32_t steps, const Frame& frame,
                         const ShapeGoals& goals) {
  const PlanMetric metric(frame.affine, steps);
  const PlanShapes shapes(tin, metric, squares_of(goals.min_angle).cosine);
  const double shortest = goals.min_edge.value_or(0);
  std::vector<std::uint8_t> is_on_line(tin.vertex_count(), 0);
  const auto visit_edges = [&](auto&& visit) {
    for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
      if (!tin.is_outside(h / 3)) visit(h, tin.origin(h), tin.origin(tin::Triangulation::next(h)));
    }
  };
  visit_edges([&](tin::HalfEdge h, tin::Vertex v, tin::Vertex w) {
    if (shapes.is_wall(h)) is_on_line[v] = is_on_line[w] = 1;
  });
  ShapeLosses losses;
  visit_edges([&](tin::HalfEdge h, tin::Vertex v, tin::Vertex w) {
    const tin::HalfEdge g = tin.twin(h);
    const bool is_first = g == tin::kNone || tin.is_outside(g / 3) || h < g;
    if (is_first && (is_on_line[v] | is_on_line[w]) != 0 && shapes.square(h) < shortest * shortest)
      ++losses.short_edges;
  });
  for (tin::Triangle t = 0; t < tin.triangle_count() && goals.min_angle > 0; ++t) {
    if (!shapes.is_sharp(t)) continue;
    const bool is_beside =
        (is_on_line[tin.origin(3 * t)] | is_on_line[tin.origin(3 * t + 1)] | is_on_line[tin.origin(3 * t + 2)]) != 0;
    if (shapes.is_forced(t)) {
      ++losses.forced;
    } else if (is_beside) {
      ++losses.beside_lines;
    }
  }
  return losses;
}

ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, const ShapeLosses& losses) {
  constexpr double kBin = 5;
  ShapeReport report;
  report.min_angle = 60;
  std::vector<std::array<std::uint32_t, 2>> shorter;  // an edge of two triangles occurs twice
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
  // Rounding of positions may have changed the counts.
  report.forced = std::min(losses.forced, report.below);
  report.below_beside_lines = std::min(losses.beside_lines, report.below - report.forced);
  report.shorter_beside_lines = std::min(losses.short_edges, report.shorter);
  return report;
}

}  // namespace scarp::shape
