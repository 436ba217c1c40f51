#include "geom/polygon_cover.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/sort.h"

namespace scarp::geom {

namespace {

/// Sweeps a plane from its first row to its last, along each row from left to right. The sweep maintains the crossed
/// edges from left to right. The positive side of an edge is its left.
class Sweep {
 public:
  Sweep(std::span<const Point> vertices, std::span<const GraphEdge> edges)
      : vertices_(vertices), edges_(edges), status_(Order{this}), places_(edges.size()) {}

  /// The cover on the positive side of each edge. cross(i, count): the cover beyond edge i, where `count` is the cover
  /// before it.
  template <class Cross>
  std::vector<std::int32_t> run(const Cross& cross) {
    std::vector<std::uint32_t> ends(edges_.size());
    std::iota(ends.begin(), ends.end(), 0u);
    sort_rarely(ends, [this](auto i, auto j) { return edges_[i][1] < edges_[j][1]; });
    std::vector<std::int32_t> before(edges_.size(), 0);
    std::size_t ended = 0;
    for (std::uint32_t i = 0; i < edges_.size();) {
      const std::uint32_t vertex = edges_[i][0];
      for (; ended < ends.size() && edges_[ends[ended]][1] <= vertex; ++ended) status_.erase(places_[ends[ended]]);
      const std::uint32_t begun = i;
      for (; i < edges_.size() && edges_[i][0] == vertex; ++i) places_[i] = status_.insert(i).first;
      auto at = places_[begun];
      while (at != status_.begin() && edges_[*std::prev(at)][0] == vertex) --at;
      std::int32_t count = at == status_.begin() ? 0 : cross(*std::prev(at), before[*std::prev(at)]);
      for (; at != status_.end() && edges_[*at][0] == vertex; ++at) {
        before[*at] = count;
        count = cross(*at, count);
      }
    }
    return before;
  }

 private:
  struct Order {
    const Sweep* sweep;
    bool operator()(std::uint32_t i, std::uint32_t j) const { return sweep->is_left(i, j); }
  };

  /// True if edge i is left of edge j, in a row that crosses both.
  bool is_left(std::uint32_t i, std::uint32_t j) const {
    if (i == j) return false;
    const auto [a, b] = edges_[i];
    const auto [c, d] = edges_[j];
    if (a <= c) return orient(vertices_[a], vertices_[b], vertices_[a == c ? d : c]) < 0;
    return orient(vertices_[c], vertices_[d], vertices_[a]) > 0;
  }

  std::span<const Point> vertices_;
  std::span<const GraphEdge> edges_;
  std::set<std::uint32_t, Order> status_;
  std::vector<std::set<std::uint32_t, Order>::iterator> places_;
};

/// Keeps edges that a polygon passes an odd number of times, by polygon.
void drop_pairs(std::vector<PolygonEdge>& passes) {
  sort_rarely(passes, [](const PolygonEdge& a, const PolygonEdge& b) {
    return a.polygon != b.polygon ? a.polygon < b.polygon : a.edge < b.edge;
  });
  std::size_t kept = 0;
  for (const PolygonEdge pass : passes) {
    if (kept > 0 && passes[kept - 1] == pass) {
      --kept;
    } else {
      passes[kept++] = pass;
    }
  }
  passes.resize(kept);
}

}  // namespace

std::vector<EdgeCover> cover_edges(std::span<const Point> vertices, std::span<const GraphEdge> edges,
                                   std::vector<PolygonEdge> passes) {
  drop_pairs(passes);
  std::vector<std::int32_t> steps(edges.size(), 0);  // cover on the negative side minus that on the positive side
  std::vector<GraphEdge> own;
  for (std::size_t begin = 0, end = 0; begin < passes.size(); begin = end) {
    own.clear();
    for (; end < passes.size() && passes[end].polygon == passes[begin].polygon; ++end) own.push_back(passes[end].edge);
    const auto before = Sweep(vertices, own).run([](std::uint32_t, std::int32_t count) { return 1 - count; });
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto at = std::lower_bound(edges.begin(), edges.end(), own[i]);
      steps[static_cast<std::size_t>(at - edges.begin())] += before[i] == 0 ? 1 : -1;
    }
  }
  const auto positive =
      Sweep(vertices, edges).run([&](std::uint32_t i, std::int32_t count) { return count + steps[i]; });
  std::vector<EdgeCover> covers(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) covers[i] = {positive[i], positive[i] + steps[i]};
  return covers;
}

}  // namespace scarp::geom
