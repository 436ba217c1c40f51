// Surfaces that lie in one layer, seen from above.
//
// Suppose that all triangles face up and each edge has one triangle, or two in opposite directions. Then the number of
// triangles over a point is the winding number of the open edges, each with its triangle on its left. So no two
// triangles overlap if the border winds around no point twice. Horizontal lines through all ends of open edges cut the
// plane into slabs. In each slab, the edges must not cross, and must lead down and up alternately, beginning with down.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/sort.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

struct Side {
  double y0, y1, x0, x1;  ///< y0 < y1
  bool leads_up;

  double at(double y) const {
    if (y <= y0) return x0;
    if (y >= y1) return x1;
    return std::clamp(x0 + (y - y0) / (y1 - y0) * (x1 - x0), std::min(x0, x1), std::max(x0, x1));
  }
};

/// Sorted by lower end. Horizontal sides are omitted, since slabs end there.
std::vector<Side> sides_of(const Mesh& mesh, std::span<const OpenEdge> open) {
  std::vector<Side> sides;
  sides.reserve(open.size());
  for (const OpenEdge& edge : open) {
    const double *a = &mesh.positions[3 * std::size_t{edge.from}], *b = &mesh.positions[3 * std::size_t{edge.to}];
    if (a[1] < b[1]) sides.push_back({a[1], b[1], a[0], b[0], true});
    if (b[1] < a[1]) sides.push_back({b[1], a[1], b[0], a[0], false});
  }
  sort_rarely(sides, [](const Side& a, const Side& b) { return a.y0 < b.y0; });
  return sides;
}

/// True if vertices of open edges share a position.
bool share_places(const Mesh& mesh, std::span<const OpenEdge> open) {
  std::vector<std::uint32_t> vertices;
  for (const OpenEdge& edge : open) vertices.insert(vertices.end(), {edge.from, edge.to});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto position = [&](std::uint32_t v) {
    const double* p = &mesh.positions[3 * std::size_t{v}];
    return std::array{p[0], p[1], p[2]};
  };
  sort_rarely(vertices, [&](std::uint32_t a, std::uint32_t b) { return position(a) < position(b); });
  return std::adjacent_find(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
           return position(a) == position(b);
         }) != vertices.end();
}

}  // namespace

bool winds_once(const Mesh& mesh, std::span<const OpenEdge> open) {
  const std::vector<Side> sides = sides_of(mesh, open);
  std::vector<double> levels;
  for (const Side& side : sides) levels.insert(levels.end(), {side.y0, side.y1});
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  const double noise = position_noise(mesh);
  // Stops if a ragged border needs more work; the caller then searches for overlaps.
  std::size_t left_to_do = 8 * mesh.triangle_count() + 1024;
  std::vector<const Side*> active;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const double low = levels[i], high = levels[i + 1], middle = low + (high - low) / 2;
    active.erase(std::remove_if(active.begin(), active.end(), [&](const Side* side) { return side->y1 <= low; }),
                 active.end());
    for (; next < sides.size() && sides[next].y0 <= low; ++next) active.push_back(&sides[next]);
    if (active.size() > left_to_do || active.size() % 2 != 0) return false;
    left_to_do -= active.size();
    sort_rarely(active, [&](const Side* a, const Side* b) { return a->at(middle) < b->at(middle); });
    for (std::size_t k = 0; k < active.size(); ++k) {
      if (active[k]->leads_up != (k % 2 == 1)) return false;
      if (k == 0) continue;
      const Side &before = *active[k - 1], &here = *active[k];
      if (before.at(low) > here.at(low) + noise || before.at(high) > here.at(high) + noise) return false;
    }
  }
  return true;
}

Connections connect(const Mesh& mesh, bool looks_up) {
  Connections found;
  if (looks_up) {
    found.edges = check_edges(mesh, {});
    const EdgeReport& edges = found.edges;
    found.is_single_layer = !edges.open.empty() && edges.open.size() <= mesh.triangle_count() / 4 + 1024 &&
                            edges.misoriented == 0 && edges.non_manifold == 0 && !share_places(mesh, edges.open) &&
                            winds_once(mesh, edges.open);
    if (found.is_single_layer) return found;
  }
  found.welded = weld_vertices(mesh);
  found.edges = check_edges(mesh, found.welded);
  return found;
}

}  // namespace scarp::judge
