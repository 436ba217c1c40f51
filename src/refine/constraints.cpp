#include "refine/constraints.h"

#include <fmt/format.h>

#include <algorithm>

namespace scarp {

namespace {

/// Whether a place belongs to the domain, closed.
bool is_in_domain(const Triangulation& tin, const Triangulation::Location& location) {
  using Kind = Triangulation::Location::Kind;
  if (!tin.is_outside(location.edge / 3)) return true;
  if (location.kind == Kind::kInside) return false;
  if (location.kind == Kind::kOnEdge) {
    const HalfEdge twin = tin.twin(location.edge);
    return twin != kNone && !tin.is_outside(twin / 3);
  }
  std::vector<Triangle> star;
  tin.star(tin.origin(location.edge), star);
  return std::any_of(star.begin(), star.end(), [&](Triangle t) { return !tin.is_outside(t); });
}

}  // namespace

Result<ConstrainedMesh> ConstrainedMesh::lay(const Raster& raster, Triangulation& tin, const ConstraintGraph& graph) {
  ConstrainedMesh mesh(raster, tin);
  tin.scale(kLatticeSteps);
  std::vector<Vertex> vertices(graph.points.size(), kNone);
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const Point p = graph.points[i];
    const auto location = tin.locate(p, tin.last_touched());
    if (!is_in_domain(tin, location)) continue;
    if (!PlaceHeights::is_sample(p)) mesh.heights_.set(p, graph.heights[i]);
    vertices[i] = tin.insert(p, location);
    mesh.fixed_.push_back(vertices[i]);
  }
  for (const auto& [a, b] : graph.edges) {
    if (vertices[a] == kNone || vertices[b] == kNone || tin.constrain(vertices[a], vertices[b])) continue;
    const Point p = graph.points[a], q = graph.points[b];
    return fail(
        ErrorKind::kInternal,
        fmt::format("the line from ({}, {}) to ({}, {}) crosses the outline between two samples", p.x, p.y, q.x, q.y));
  }
  return mesh;
}

VertexPlaces ConstrainedMesh::places() const {
  VertexPlaces places{kLatticeSteps, {}, {}};
  places.heights.reserve(tin_->vertex_count());
  for (Vertex v = 0; v < tin_->vertex_count(); ++v) places.heights.push_back(heights_.at(tin_->point(v)));
  places.fixed.assign(tin_->vertex_count(), 0);
  for (const Vertex v : fixed_) places.fixed[v] = 1;
  return places;
}

}  // namespace scarp
