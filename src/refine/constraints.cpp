#include "refine/constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

/// The bits of a coordinate, every other one.
std::uint64_t spread(std::int32_t coordinate) {
  auto bits = static_cast<std::uint64_t>(static_cast<std::uint32_t>(coordinate));
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// Indices of points along Morton's curve: whoever looks for one after the other in a triangulation has short ways.
std::vector<std::uint32_t> nearby_order(const std::vector<Point>& points) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(points.size());
  for (const Point p : points)
    keys.emplace_back(spread(p.y) << 1 | spread(p.x), static_cast<std::uint32_t>(keys.size()));
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

}  // namespace

Result<ConstrainedMesh> ConstrainedMesh::lay(const Raster& raster, Triangulation& tin, const ConstraintGraph& graph) {
  ConstrainedMesh mesh(raster, tin);
  tin.scale(kLatticeSteps);
  std::vector<Vertex> vertices(graph.points.size(), kNone);
  for (const std::uint32_t i : nearby_order(graph.points)) {
    const Point p = graph.points[i];
    const auto location = tin.locate(p, tin.last_touched());
    if (!is_in_domain(tin, location)) continue;
    if (!PlaceHeights::is_sample(p)) mesh.heights_.set(p, graph.heights[i]);
    vertices[i] = tin.insert(p, location);
    mesh.fixed_.push_back(vertices[i]);
  }
  std::vector<Point> begins;
  begins.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) begins.push_back(graph.points[edge[0]]);
  for (const std::uint32_t i : nearby_order(begins)) {
    const auto& [a, b] = graph.edges[i];
    if (vertices[a] == kNone || vertices[b] == kNone || tin.constrain(vertices[a], vertices[b])) continue;
    const Point p = graph.points[a], q = graph.points[b];
    return fail(
        ErrorKind::kInternal,
        fmt::format("the line from ({}, {}) to ({}, {}) crosses the outline between two samples", p.x, p.y, q.x, q.y));
  }
  if (graph.cut) {
    if (auto cut = cut_away(tin, raster.cols, *graph.cut, vertices); !cut) return tl::unexpected(cut.error());
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
