// Edges and the borders they form.
//
// Half-edges are sorted by their smaller vertex (counting sort), then by the larger one within each vertex's short
// list: equal ones are the triangles around one edge.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>

#include "base/bits.h"
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

struct HalfEdge {
  std::uint32_t other = 0;  ///< the larger vertex
  std::uint32_t half = 0;   ///< 3·triangle + corner it starts from
};

class EdgeList {
 public:
  EdgeList(const Mesh& mesh, std::span<const std::uint32_t> welded) : mesh_(mesh), welded_(welded) {
    starts_.assign(welded.size() + 1, 0);
    each_half([&](std::uint32_t low, HalfEdge) { ++starts_[low + 1]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    halves_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    each_half([&](std::uint32_t low, HalfEdge edge) { halves_[next[low]++] = edge; });
    for (std::size_t v = 0; v < welded.size(); ++v) {
      std::sort(halves_.begin() + starts_[v], halves_.begin() + starts_[v + 1],
                [](const HalfEdge& a, const HalfEdge& b) {
                  return a.other != b.other ? a.other < b.other : a.half < b.half;
                });
    }
  }

  std::uint32_t from(std::uint32_t half) const { return welded_[mesh_.triangles[half]]; }
  std::uint32_t to(std::uint32_t half) const { return welded_[mesh_.triangles[next_corner(half)]]; }
  static std::uint32_t next_corner(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }

  /// Calls visit(half-edges of one edge) for each edge.
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v) {
      for (std::size_t i = starts_[v], end = i; i < starts_[v + 1]; i = end) {
        while (end < starts_[v + 1] && halves_[end].other == halves_[i].other) ++end;
        visit(std::span<const HalfEdge>(&halves_[i], end - i));
      }
    }
  }

 private:
  template <class Visit>
  void each_half(const Visit& visit) const {
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const std::array<std::uint32_t, 3> v{welded_[mesh_.triangles[3 * t]], welded_[mesh_.triangles[3 * t + 1]],
                                           welded_[mesh_.triangles[3 * t + 2]]};
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = v[k], b = v[(k + 1) % 3];
        visit(std::min(a, b), HalfEdge{std::max(a, b), static_cast<std::uint32_t>(3 * t + k)});
      }
    }
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> welded_;
  std::vector<std::size_t> starts_;  // by smaller vertex
  std::vector<HalfEdge> halves_;
};

/// Corners that are joined by edges of two triangles form fans; an open edge ends a fan at both its vertices, and each
/// fan with an end has two. So the open edges chained through fans are the loops, also where loops touch in a vertex.
std::uint64_t count_loops(const EdgeList& edges, std::size_t corners, std::span<const OpenEdge> open,
                          std::span<const std::uint32_t> open_halves) {
  UnionFind fans(corners);
  edges.each_edge([&](std::span<const HalfEdge> around) {
    if (around.size() != 2) return;
    const std::uint32_t a = around[0].half, b = around[1].half;
    const bool same_start = edges.from(a) == edges.from(b);
    fans.join(a, same_start ? b : EdgeList::next_corner(b));
    fans.join(EdgeList::next_corner(a), same_start ? EdgeList::next_corner(b) : b);
  });
  for (const std::uint32_t half : open_halves) fans.join(half, EdgeList::next_corner(half));
  std::vector<std::uint32_t> loops;
  loops.reserve(open.size());
  for (const std::uint32_t half : open_halves) loops.push_back(fans.find(half));
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
  edges.each_edge([&](std::span<const HalfEdge> around) {
    const auto forward = static_cast<std::size_t>(
        std::count_if(around.begin(), around.end(), [&](const HalfEdge& e) { return edges.to(e.half) == e.other; }));
    if (around.size() == 1) {
      const std::uint32_t half = around[0].half;
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
    report.loops = count_loops(edges, mesh.triangles.size(), report.open, open_halves);
  }
  return report;
}

}  // namespace scarp::judge
