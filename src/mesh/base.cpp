// From a terrain to a solid: top, walls, floor.
//
// The only trap is a border vertex at which two parts of the domain touch (two cells that share a corner and no edge).
// Its vertical wall edge would have four triangles. Each fan of triangles around such a vertex therefore gets a vertex
// of its own before anything else is built; after that, every border vertex has one border edge in and one out, so
// walls close around it.

#include <cmath>

#include "mesh/attributes.h"
#include "mesh/flat_base.h"
#include "mesh/half_edges.h"
#include "scarp/mesh.h"

namespace scarp {
namespace {

/// Border half-edges are those without a twin; each fan around a vertex has exactly one that starts there.
void split_fans(Mesh& mesh, const std::vector<std::uint32_t>& twins) {
  std::vector<bool> has_fan(mesh.vertex_count(), false);
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != kNoHalfEdge) continue;
    const std::uint32_t vertex = mesh.triangles[h];
    if (!has_fan[vertex]) {
      has_fan[vertex] = true;
      continue;
    }
    const auto copy = static_cast<std::uint32_t>(mesh.vertex_count());
    for (std::size_t k = 0; k < 3; ++k) mesh.positions.push_back(mesh.positions[3 * std::size_t{vertex} + k]);
    append_attributes_of(mesh, vertex);
    for (std::uint32_t corner = h; corner != kNoHalfEdge; corner = twins[previous_half_edge(corner)]) {
      mesh.triangles[corner] = copy;
    }
  }
}

bool is_below_all(const Mesh& mesh, double base) {
  const auto offset = static_cast<float>(base - mesh.origin[2]);
  if (!std::isfinite(offset)) return false;
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3) {
    if (!(mesh.origin[2] + mesh.positions[i] > base) || !(static_cast<float>(mesh.positions[i]) > offset)) return false;
  }
  return true;
}

}  // namespace

bool add_base(Mesh& mesh, double base) {
  if (!is_below_all(mesh, base)) return false;
  mesh.normals.clear();
  const std::vector<std::uint32_t> twins = build_twins(mesh.triangles);
  split_fans(mesh, twins);
  std::vector<std::uint32_t> floor = build_flat_base(mesh.positions, mesh.triangles, twins);

  const std::vector<std::uint32_t> top = mesh.triangles;
  std::vector<std::uint32_t> below(mesh.vertex_count(), kNoHalfEdge);  // the floor's copy of each vertex
  const auto drop = [&](std::uint32_t v) {
    if (below[v] == kNoHalfEdge) {
      below[v] = static_cast<std::uint32_t>(mesh.vertex_count());
      const double x = mesh.positions[3 * std::size_t{v}], y = mesh.positions[3 * std::size_t{v} + 1];
      mesh.positions.insert(mesh.positions.end(), {x, y, base - mesh.origin[2]});
      append_attributes_of(mesh, v);
    }
    return below[v];
  };
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != kNoHalfEdge) continue;
    const std::uint32_t a = top[h], b = top[next_half_edge(h)], low_a = drop(a), low_b = drop(b);
    mesh.triangles.insert(mesh.triangles.end(), {b, a, low_a, b, low_a, low_b});
  }
  for (std::size_t t = 0; t < floor.size(); t += 3) {
    mesh.triangles.insert(mesh.triangles.end(), {drop(floor[t]), drop(floor[t + 2]), drop(floor[t + 1])});
  }
  return true;
}

}  // namespace scarp
