#include "lines/constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/curve.h"
#include "base/parallel.h"
#include "base/radix_sort.h"

namespace scarp::lines {

namespace {

/// True if a lattice point belongs to the closed domain.
bool is_in_domain(const tin::Triangulation& tin, const tin::Triangulation::Location& location) {
  using Kind = tin::Triangulation::Location::Kind;
  if (!tin.is_outside(location.edge / 3)) return true;
  if (location.kind == Kind::kInside) return false;
  if (location.kind == Kind::kOnEdge) {
    const tin::HalfEdge twin = tin.twin(location.edge);
    return twin != tin::kNone && !tin.is_outside(twin / 3);
  }
  std::vector<tin::Triangle> star;
  tin.star(tin.origin(location.edge), star);
  return std::any_of(star.begin(), star.end(), [&](tin::Triangle t) { return !tin.is_outside(t); });
}

/// Indices of points in Morton order, which shortens successive searches in a triangulation.
std::vector<std::uint32_t> nearby_order(const std::vector<Point>& points) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(points.size());
  for (const Point p : points)
    keys.emplace_back(curve_place(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y)),
                      static_cast<std::uint32_t>(keys.size()));
  radix_sort(keys, [](const auto& key) { return key.first; });
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

/// The corners of all triangles.
std::vector<tin::Vertex> corners_of(const tin::Triangulation& tin) {
  std::vector<tin::Vertex> corners(3 * tin.triangle_count());
  for (tin::HalfEdge h = 0; h < corners.size(); ++h) corners[h] = tin.origin(h);
  return corners;
}

/// Makes a triangle at a vertex the last touched one, so that a query for the vertex's edges need not search.
void touch(tin::Triangulation& tin, tin::Vertex v, tin::Triangle hint) {
  const tin::HalfEdge last = 3 * tin.last_touched();
  if (tin.origin(last) == v || tin.origin(last + 1) == v || tin.origin(last + 2) == v) return;
  tin.insert(tin.point(v), tin.locate(tin.point(v), hint));
}

bool is_start(const ConstraintGraph& graph, std::size_t edge) {
  return !graph.is_start.empty() && graph.is_start[edge] != 0;
}

/// True for points with a permanent edge.
std::vector<bool> held_points(const ConstraintGraph& graph) {
  std::vector<bool> is_held(graph.points.size(), false);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (is_start(graph, i)) continue;
    for (const std::uint32_t end : graph.edges[i]) is_held[end] = true;
  }
  return is_held;
}

}  // namespace

Result<ConstrainedMesh> ConstrainedMesh::insert(const grid::Raster& raster, tin::Triangulation& tin,
                                                const ConstraintGraph& graph) {
  ConstrainedMesh mesh(raster, tin);
  const std::vector<tin::Vertex> corners = corners_of(tin);
  tin.scale(grid::kLatticeSteps);
  std::vector<tin::Vertex> vertices(graph.points.size(), tin::kNone);
  const std::vector<bool> is_held = held_points(graph);
  mesh.heights_.reserve(graph.points.size());
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (!metric::LatticeHeights::is_sample(graph.points[i])) mesh.heights_.set(graph.points[i], graph.heights[i]);
  }
  std::vector<tin::Triangle> near(graph.points.size(), 0);
  for (const std::uint32_t i : nearby_order(graph.points)) {
    const Point p = graph.points[i];
    const auto location = tin.locate(p, tin.last_touched());
    const bool is_shared = !graph.is_shared.empty() && graph.is_shared[i] != 0;
    if (!is_shared && !is_in_domain(tin, location)) continue;
    vertices[i] = tin.insert(p, location);
    near[i] = tin.last_touched();
    (is_held[i] ? mesh.fixed_ : mesh.starts_).push_back(vertices[i]);
  }
  std::vector<Point> begins;
  begins.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) begins.push_back(graph.points[edge[0]]);
  for (const std::uint32_t i : nearby_order(begins)) {
    const auto& [a, b] = graph.edges[i];
    if (vertices[a] == tin::kNone || vertices[b] == tin::kNone) continue;
    if (is_start(graph, i)) mesh.start_edges_.push_back({vertices[a], vertices[b]});
    touch(tin, vertices[a], near[a]);
    if (tin.constrain(vertices[a], vertices[b])) continue;
    const Point p = graph.points[a], q = graph.points[b];
    return fail(
        ErrorKind::kInternal,
        fmt::format("the line from ({}, {}) to ({}, {}) crosses the outline between two samples", p.x, p.y, q.x, q.y));
  }
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    bool is_old = 3 * t < corners.size();
    for (tin::HalfEdge h = 3 * t; is_old && h < 3 * t + 3; ++h) is_old = corners[h] == tin.origin(h);
    if (!is_old) mesh.changed_.push_back(t);
  }
  if (graph.cut) mesh.has_surface_ = cut_away(tin, *graph.cut, vertices);
  return mesh;
}

void ConstrainedMesh::release_starts(tin::Triangulation& tin) {
  for (const auto& [a, b] : start_edges_) {
    const tin::HalfEdge h = tin.find_edge(a, b);
    // An edge with a sample on it has been split; both parts remain.
    if (h != tin::kNone && tin.twin(h) != tin::kNone) tin.release(h);
  }
  starts_.clear();
}

grid::VertexLattice ConstrainedMesh::lattice(int threads) const {
  grid::VertexLattice lattice{grid::kLatticeSteps, {}, {}};
  lattice.heights.resize(tin_->vertex_count());
  constexpr std::size_t kTogether = 1 << 15;
  parallel_for((lattice.heights.size() + kTogether - 1) / kTogether, threads, [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kTogether, lattice.heights.size());
    for (std::size_t v = part * kTogether; v < end; ++v)
      lattice.heights[v] = heights_.at(tin_->point(static_cast<tin::Vertex>(v)));
  });
  lattice.fixed.assign(tin_->vertex_count(), 0);
  for (const tin::Vertex v : fixed_) lattice.fixed[v] = 1;
  for (const tin::Vertex v : starts_) lattice.fixed[v] = 1;
  return lattice;
}

}  // namespace scarp::lines
