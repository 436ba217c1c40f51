// Edges and the borders that they form.
//
// Half-edges are sorted by their smaller vertex (counting sort), then by the larger vertex within each vertex's short
// list. Equal half-edges belong to the triangles around one edge.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>

#include "base/array.h"
#include "base/bits.h"
#include "base/sort.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Half-edges by their smaller vertex, then the larger one, then their number, 3·triangle + their first corner.
class EdgeList {
 public:
  /// The larger vertex, then the half-edge's number, as one sort key.
  struct HalfEdge {
    std::uint64_t key;

    std::uint32_t other() const { return static_cast<std::uint32_t>(key >> 32); }
    std::uint32_t half() const { return static_cast<std::uint32_t>(key); }
    friend bool operator<(HalfEdge a, HalfEdge b) { return a.key < b.key; }
  };

  EdgeList(const Mesh& mesh, std::span<const std::uint32_t> welded) : mesh_(mesh), welded_(welded) {
    const std::size_t vertices = mesh.vertex_count();
    starts_.resize(vertices + 2);
    std::fill(starts_.begin(), starts_.end(), 0u);
    // Counts are stored two places ahead, so that starts_[v + 1] is the next free slot of v during filling.
    each_half([&](std::uint32_t low, HalfEdge) { ++starts_[low + 2]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    halves_.resize(starts_.back());
    each_half([&](std::uint32_t low, HalfEdge edge) { halves_[starts_[low + 1]++] = edge; });
    for (std::size_t v = 0; v < vertices; ++v) sort(halves_.begin() + starts_[v], halves_.begin() + starts_[v + 1]);
  }

  std::uint32_t from(std::uint32_t half) const { return vertex(mesh_.triangles[half]); }
  std::uint32_t to(std::uint32_t half) const { return vertex(mesh_.triangles[next_corner(half)]); }
  static std::uint32_t next_corner(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }

  /// Calls visit(half-edges of one edge) for each edge.
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (std::size_t v = 0; v + 2 < starts_.size(); ++v) {
      for (std::size_t i = starts_[v], end = i; i < starts_[v + 1]; i = end) {
        do ++end;
        while (end < starts_[v + 1] && halves_[end].other() == halves_[i].other());
        visit(std::span<const HalfEdge>(&halves_[i], end - i));
      }
    }
  }

 private:
  static void sort(HalfEdge* first, HalfEdge* last) {
    constexpr std::ptrdiff_t kFew = 24;
    std::span edges(first, last);
    if (last - first > kFew) return sort_rarely(edges);
    for (HalfEdge* next = first; next < last; ++next) {
      const HalfEdge edge = *next;
      HalfEdge* hole = next;
      for (; hole > first && edge < hole[-1]; --hole) *hole = hole[-1];
      *hole = edge;
    }
  }
  std::uint32_t vertex(std::uint32_t v) const { return welded_.empty() ? v : welded_[v]; }
  template <class Visit>
  void each_half(const Visit& visit) const {
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const std::array<std::uint32_t, 3> v{vertex(mesh_.triangles[3 * t]), vertex(mesh_.triangles[3 * t + 1]),
                                           vertex(mesh_.triangles[3 * t + 2])};
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = v[k], b = v[k == 2 ? 0 : k + 1];
        visit(std::min(a, b), HalfEdge{std::uint64_t{std::max(a, b)} << 32 | static_cast<std::uint32_t>(3 * t + k)});
      }
    }
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> welded_;
  Array<std::uint32_t> starts_;  // by smaller vertex
  Array<HalfEdge> halves_;
};

/// Corners connected by edges of two triangles form fans. An open edge ends a fan at both its vertices, and each fan
/// with an end has two ends. So the open edges chained through fans are the loops, even if loops touch in a vertex.
/// Only fans at vertices of open edges matter.
std::uint64_t count_loops(const Mesh& mesh, const EdgeList& edges, std::span<const OpenEdge> open,
                          std::span<const std::uint32_t> open_halves) {
  std::vector<bool> is_end(mesh.vertex_count());
  for (const OpenEdge& edge : open) is_end[edge.from] = is_end[edge.to] = true;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t corner = 0; corner < mesh.triangles.size(); ++corner) {
    if (is_end[edges.from(corner)]) corners.push_back(corner);
  }
  const auto place = [&](std::uint32_t corner) {
    return static_cast<std::uint32_t>(std::lower_bound(corners.begin(), corners.end(), corner) - corners.begin());
  };
  UnionFind fans(corners.size());
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (is_end[edges.from(a)]) fans.join(place(a), place(b));
  };
  edges.each_edge([&](std::span<const EdgeList::HalfEdge> around) {
    if (around.size() != 2) return;
    const std::uint32_t a = around[0].half(), b = around[1].half();
    const bool same_start = edges.from(a) == edges.from(b);
    join(a, same_start ? b : EdgeList::next_corner(b));
    join(EdgeList::next_corner(a), same_start ? EdgeList::next_corner(b) : b);
  });
  for (const std::uint32_t half : open_halves) fans.join(place(half), place(EdgeList::next_corner(half)));
  std::vector<std::uint32_t> loops;
  loops.reserve(open.size());
  for (const std::uint32_t half : open_halves) loops.push_back(fans.find(place(half)));
  std::sort(loops.begin(), loops.end());
  return static_cast<std::uint64_t>(std::unique(loops.begin(), loops.end()) - loops.begin());
}

std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 32)) * 0xd6e8feb86659fd93u;
  return value ^ (value >> 29);
}

}  // namespace

std::vector<std::uint32_t> weld_vertices(const Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  const std::size_t mask = std::bit_ceil(count * 2 + 1) - 1;
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slots(mask + 1, kFree), first(count);
  for (std::size_t v = 0; v < count; ++v) {
    const double* p = &mesh.positions[3 * v];
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) hash = mix(hash ^ bit_cast<std::uint64_t>(p[k] + 0.0));  // −0 is 0
    std::size_t slot = hash & mask;
    while (slots[slot] != kFree) {
      const double* q = &mesh.positions[3 * std::size_t{slots[slot]}];
      if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) break;
      slot = (slot + 1) & mask;
    }
    if (slots[slot] == kFree) slots[slot] = static_cast<std::uint32_t>(v);
    first[v] = slots[slot];
  }
  return first;
}

EdgeReport check_edges(const Mesh& mesh, std::span<const std::uint32_t> welded) {
  const EdgeList edges(mesh, welded);
  EdgeReport report;
  std::vector<std::uint32_t> open_halves;
  std::uint64_t contacts = 0;
  edges.each_edge([&](std::span<const EdgeList::HalfEdge> around) {
    const auto forward = static_cast<std::size_t>(std::count_if(
        around.begin(), around.end(), [&](EdgeList::HalfEdge edge) { return edges.to(edge.half()) == edge.other(); }));
    if (around.size() == 1) {
      const std::uint32_t half = around[0].half();
      report.open.push_back({edges.from(half), edges.to(half), half / 3});
      open_halves.push_back(half);
    } else if (around.size() == 2) {
      report.misoriented += forward != 1;
    } else {
      ++report.non_manifold;
      contacts += around.size() == 4 && forward == 2;
    }
  });
  if (report.open.empty()) {
    report.non_manifold -= contacts;
  } else {
    report.loops = count_loops(mesh, edges, report.open, open_halves);
  }
  return report;
}

}  // namespace scarp::judge
