#include "mesh/half_edges.h"

#include <algorithm>

namespace scarp::mesh {

std::vector<std::uint32_t> build_twins(std::span<const std::uint32_t> triangles) {
  struct Edge {
    std::uint64_t ends;  // smaller vertex, larger vertex
    std::uint32_t half_edge;
    bool operator<(const Edge& other) const {
      return ends != other.ends ? ends < other.ends : half_edge < other.half_edge;
    }
  };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::vector<Edge> edges(count);
  for (std::uint32_t h = 0; h < count; ++h) {
    const auto [low, high] = std::minmax(triangles[h], triangles[next_half_edge(h)]);
    edges[h] = {std::uint64_t{low} << 32 | high, h};
  }
  std::sort(edges.begin(), edges.end());

  std::vector<std::uint32_t> twins(count, kNoHalfEdge);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    for (end = begin; end < edges.size() && edges[end].ends == edges[begin].ends;) ++end;
    if (end - begin != 2) continue;
    const std::uint32_t a = edges[begin].half_edge, b = edges[begin + 1].half_edge;
    if (triangles[a] == triangles[b]) continue;  // both in the same direction
    twins[a] = b;
    twins[b] = a;
  }
  return twins;
}

}  // namespace scarp::mesh
