// Laws of lines in a mesh: any insertion, removal or move preserves the lines and the bound.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "laws/fit_meshes.h"
#include "lines/constraints.h"

namespace scarp::constraints_laws_test {
namespace {

using testing::Field;

/// Some edges of a triangulation of arbitrary lattice points, so they do not cross. Heights are near those of the
/// raster.
lines::ConstraintGraph any_graph(const Field& field) {
  tin::Triangulation tin(testing::in_steps(field.cols), testing::in_steps(field.rows));
  const int count = *rc::gen::inRange(0, 30);
  const std::int32_t grain = *rc::gen::element(1, 16, grid::kLatticeSteps / 2, grid::kLatticeSteps);
  for (int i = 0; i < count; ++i) {
    const Point p{*rc::gen::inRange(0, (field.cols - 1) * grid::kLatticeSteps / grain + 1) * grain,
                  *rc::gen::inRange(0, (field.rows - 1) * grid::kLatticeSteps / grain + 1) * grain};
    tin.insert(p, tin.locate(p, tin.last_touched()));
  }
  lines::ConstraintGraph graph;
  std::map<tin::Vertex, std::uint32_t> numbers;
  const auto number_of = [&](tin::Vertex v) {
    const auto [at, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(graph.points.size()));
    if (is_new) {
      const Point p = tin.point(v);
      const float sample = field.raster().at({p.x / grid::kLatticeSteps, p.y / grid::kLatticeSteps});
      graph.points.push_back(p);
      graph.heights.push_back((std::isnan(sample) ? 0 : sample) + static_cast<float>(*rc::gen::inRange(-8, 9)));
    }
    return at->second;
  };
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) != tin::kNone && (tin.twin(h) < h || *rc::gen::inRange(0, 3) > 0)) continue;
    if (tin.twin(h) == tin::kNone && *rc::gen::arbitrary<bool>()) continue;
    const std::uint32_t a = number_of(tin.origin(h)), b = number_of(tin.origin(tin::Triangulation::next(h)));
    graph.edges.push_back({a, b});
  }
  return graph;
}

std::optional<tin::Vertex> find_vertex(const tin::Triangulation& tin, Point p) {
  const auto location = tin.locate(p, tin.last_touched());
  if (location.kind != tin::Triangulation::Location::Kind::kOnVertex) return std::nullopt;
  return tin.origin(location.edge);
}

/// The first edge of the graph that is not a chain of edges of the mesh.
std::string find_lost_line(const tin::Triangulation& tin, const lines::ConstraintGraph& graph) {
  for (const auto& [a, b] : graph.edges) {
    const Point p = graph.points[a], q = graph.points[b];
    const auto from = find_vertex(tin, p), to = find_vertex(tin, q);
    if (!from || !to) return fmt::format("no vertex at ({}, {}) or ({}, {})", p.x, p.y, q.x, q.y);
    std::vector<tin::Triangle> star;
    for (tin::Vertex at = *from; at != *to;) {
      tin::Vertex next = tin::kNone;
      tin.star(at, star);
      for (const tin::Triangle t : star) {
        for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
          const tin::Vertex u = tin.origin(h), w = tin.origin(tin::Triangulation::next(h));
          if (u != at && w != at) continue;
          const tin::Vertex other = u == at ? w : u;
          const Point o = tin.point(other), here = tin.point(at);
          const bool is_ahead = std::int64_t{o.x - here.x} * (q.x - p.x) + std::int64_t{o.y - here.y} * (q.y - p.y) > 0;
          if (tin.is_constrained(h) && orient(p, q, o) == 0 && is_ahead) next = other;
        }
      }
      if (next == tin::kNone) return fmt::format("the line from ({}, {}) to ({}, {}) is cut", p.x, p.y, q.x, q.y);
      at = next;
    }
  }
  return "";
}

/// The first point of the graph with a wrong place or height; the height must be the sample's, if any.
std::string find_moved_point(const fit::Fitted& fitted, const lines::ConstraintGraph& graph,
                             const grid::Raster& raster) {
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const Point p = graph.points[i];
    const auto v = find_vertex(fitted.tin, p);
    if (!v) return fmt::format("no vertex at ({}, {})", p.x, p.y);
    const float height = metric::LatticeHeights::is_sample(p)
                             ? raster.at({p.x / grid::kLatticeSteps, p.y / grid::kLatticeSteps})
                             : graph.heights[i];
    if (fitted.lattice.heights[*v] != height) return fmt::format("another height at ({}, {})", p.x, p.y);
  }
  return "";
}

RC_GTEST_PROP(constraints, lines_and_the_bound_survive_refinement_and_fitting, ()) {
  const auto cols = *rc::gen::inRange(2, 30), rows = *rc::gen::inRange(2, 30);
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows,
                                            testing::kReliefs[*rc::gen::inRange(0, 5)]);
  const double threshold = *rc::gen::element(0.0, 0.5, 1.0, 7.3, 30.0);
  const lines::ConstraintGraph graph = any_graph(field);
  auto tin = *testing::refined(field, threshold);
  auto inserted = lines::ConstrainedMesh::insert(field.raster(), tin, graph);
  RC_ASSERT(inserted.has_value());
  RC_ASSERT(find_lost_line(tin, graph) == "");
  {
    const metric::LatticeMetric metric(field.raster(), inserted->heights(), threshold, {});
    refine::Refinement refinement(metric, tin);
    while (!refinement.done()) refinement.insert_worst();
  }
  fit::FitOptions options;
  options.threshold = threshold;
  options.depth = *rc::gen::element(fit::FitDepth{}, fit::kHighDepth);
  options.vertices_are_free = options.depth.rounds > 0 && *rc::gen::arbitrary<bool>();
  options.min_shape = *rc::gen::element(0.0, 0.1);
  options.patch_side = *rc::gen::element(0, 7);
  options.threads = *rc::gen::element(1, 2);
  grid::VertexLattice lattice = inserted->lattice();
  fit::Fitted before{std::move(tin), {}, std::move(lattice)};
  RC_ASSERT(testing::find_broken_bound(field.raster(), before, threshold) == "");
  const std::size_t vertices = before.tin.vertex_count();
  const fit::Fitted fitted = *fit::fit(field.raster(), std::move(before.tin), std::move(before.lattice), options);
  RC_ASSERT(fitted.tin.vertex_count() <= vertices);
  RC_ASSERT(testing::find_broken_bound(field.raster(), fitted, threshold) == "");
  RC_ASSERT(find_lost_line(fitted.tin, graph) == "");
  RC_ASSERT(find_moved_point(fitted, graph, field.raster()) == "");
}

TEST(constraints, heights_of_thousands_of_lattice_points_are_found_again) {
  const std::vector<float> samples(4, 7.0F);
  metric::LatticeHeights heights(grid::Raster{samples.data(), 2, 2});
  const auto is_between = [](std::int32_t k) { return !metric::LatticeHeights::is_sample({k % 257, k / 257}); };
  for (std::int32_t round : {0, 1}) {
    for (std::int32_t k = 0; k < 257 * 257; k += 7) {
      if (is_between(k)) heights.set({k % 257, k / 257}, static_cast<float>(k + round));
    }
  }
  for (std::int32_t k = 0; k < 257 * 257; k += 7)
    ASSERT_EQ(heights.at({k % 257, k / 257}), is_between(k) ? static_cast<float>(k + 1) : 7.0F);
}

}  // namespace
}  // namespace scarp::constraints_laws_test
