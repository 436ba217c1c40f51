// Problem: a floor for a solid needs the outline of the terrain without inner vertices. Triangulating an outline with
// holes from scratch needs a polygon triangulator. But there already is a triangulation, with too many vertices.
//
// Idea: remove the inner vertices, one at a time. Removing v leaves a star-shaped hole, the ring of its neighbours.
// Three successive neighbours p, q, r are an ear that may be cut off if they turn left and v lies strictly left of p→r.
// The rest is still star-shaped around v. The test uses only these four points, so cutting an ear changes only the
// results for its two neighbours. While more than four neighbours remain, such an ear exists: any triangulation of the
// ring has two or more ears, and one of them does not touch v. With four neighbours, v may lie on a diagonal. Vertices
// with few neighbours are removed first, which keeps rings short. Orientation is exact, and the border and all edges
// along it never change, so the result fits the walls.
//
// Then border vertices that lie between their neighbours on a line along x or y are removed. Such a vertex v has half a
// star, whose ring is closed by that line. The test above still works with v on the line: an ear at either end of the
// line has v on its wrong side, and another ear always exists.
//
// Slanted borders cause rings whose corners are collinear except for rounding. Such thin ears are not cut, since a
// writer that rounds again would fold them; a vertex that needs one is kept.
//
// This is vertex deletion by ear queue without its Delaunay priority (Devillers 2002, "On deletion in Delaunay
// triangulations"): a floor may have long thin triangles.

#include "mesh/flat_base.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "mesh/exact_orient.h"
#include "mesh/half_edges.h"

namespace scarp::mesh {
namespace {

class FlatBase {
 public:
  FlatBase(std::span<const double> positions, std::vector<std::uint32_t> triangles, std::vector<std::uint32_t> twins)
      : positions_(positions), triangles_(std::move(triangles)), twins_(std::move(twins)) {}

  std::vector<std::uint32_t> build() {
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      if (!turns_left(triangles_[t], triangles_[t + 1], triangles_[t + 2])) return std::move(triangles_);
    }
    find_degrees();
    remove_vertices(false);
    remove_vertices(true);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      if (triangles_[t] == triangles_[t + 1]) continue;  // a released slot
      for (std::size_t k = 0; k < 3; ++k) triangles_[kept++] = triangles_[t + k];
    }
    triangles_.resize(kept);
    return std::move(triangles_);
  }

 private:
  struct RingEdge {
    std::uint32_t start;   // the vertex from which the edge leads to the next ring vertex
    std::uint32_t across;  // the half-edge in the opposite direction, or kNoHalfEdge
    std::uint32_t previous, next;
  };
  struct Ear {
    std::uint32_t corners[3];
    std::uint32_t across[2];  // links of the edges 0→1 and 1→2; a later ear links the third
  };

  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto point = [&](std::size_t v) { return Point2{positions_[3 * v], positions_[3 * v + 1]}; };
    return exact_orient(point(a), point(b), point(c));
  }
  bool turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const { return orient(a, b, c) > 0; }

  /// True if a triangle turns left even after its corners are moved and rounded again, judged by its height relative to
  /// its longest side.
  bool is_firm(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    constexpr double kThinnest = 0x1p-36;
    const auto side = [&](std::uint32_t from, std::uint32_t to, std::size_t axis) {
      return positions_[3 * std::size_t{to} + axis] - positions_[3 * std::size_t{from} + axis];
    };
    const auto square = [&](std::uint32_t from, std::uint32_t to) {
      return side(from, to, 0) * side(from, to, 0) + side(from, to, 1) * side(from, to, 1);
    };
    const double area = side(a, b, 0) * side(a, c, 1) - side(a, b, 1) * side(a, c, 0);
    return turns_left(a, b, c) && area >= kThinnest * std::max({square(a, b), square(b, c), square(c, a)});
  }

  void find_degrees() {
    const std::size_t vertices = positions_.size() / 3;
    degrees_.assign(vertices, 0);
    outgoing_.assign(vertices, kNoHalfEdge);
    on_border_.assign(vertices, false);
    for (std::uint32_t h = 0; h < triangles_.size(); ++h) {
      outgoing_[triangles_[h]] = h;
      ++degrees_[triangles_[h]];
      if (twins_[h] == kNoHalfEdge) on_border_[triangles_[h]] = on_border_[triangles_[next_half_edge(h)]] = true;
    }
  }

  /// Removes unneeded border vertices, or all inner vertices.
  void remove_vertices(bool of_border) {
    using Entry = std::pair<std::uint32_t, std::uint32_t>;  // neighbours, vertex
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::uint32_t v = 0; v < degrees_.size(); ++v) {
      if (degrees_[v] > 0 && on_border_[v] == of_border) queue.push({degrees_[v], v});
    }
    while (!queue.empty()) {
      const auto [degree, v] = queue.top();
      queue.pop();
      if (degree != degrees_[v]) continue;  // an outdated entry
      collect_ring(v);
      if (star_.size() != degree || (of_border && !is_straight(v)) || !cut_ears(v)) continue;
      for (const std::uint32_t t : star_) {
        for (std::uint32_t k = 0; k < 3; ++k) --degrees_[triangles_[3 * t + k]];
      }
      for (const Ear& ear : ears_) {
        for (const std::uint32_t corner : ear.corners) ++degrees_[corner];
      }
      replace_star();
      for (const RingEdge& edge : ring_) {
        if (on_border_[edge.start] == of_border) queue.push({degrees_[edge.start], edge.start});
      }
    }
  }

  /// The neighbours of v, counter-clockwise, and the triangles around it; for a border vertex from border to border.
  void collect_ring(std::uint32_t v) {
    ring_.clear();
    star_.clear();
    std::uint32_t first = outgoing_[v];
    while (on_border_[v] && twins_[first] != kNoHalfEdge) first = next_half_edge(twins_[first]);
    std::uint32_t h = first;
    const auto add = [this](std::uint32_t start, std::uint32_t across) {
      const auto at = static_cast<std::uint32_t>(ring_.size());
      ring_.push_back({start, across, at - 1, at + 1});
    };
    do {
      const std::uint32_t opposite = next_half_edge(h), last = previous_half_edge(h);
      add(triangles_[opposite], twins_[opposite]);
      star_.push_back(h / 3);
      h = twins_[last];
      if (h == kNoHalfEdge) add(triangles_[last], kNoHalfEdge);
    } while (h != first && h != kNoHalfEdge);
    ring_.front().previous = static_cast<std::uint32_t>(ring_.size() - 1);
    ring_.back().next = 0;
  }

  /// True for a straight border vertex, whose neighbours on the border end its ring. Scaling, moving or rounding single
  /// coordinates keeps lines along an axis straight, and the walls below them vertical.
  bool is_straight(std::uint32_t v) const {
    const double *from = &positions_[3 * std::size_t{ring_.back().start}], *at = &positions_[3 * std::size_t{v}],
                 *to = &positions_[3 * std::size_t{ring_.front().start}];
    const auto is_between = [](double a, double b, double c) { return (a < b && b < c) || (c < b && b < a); };
    return (from[0] == at[0] && at[0] == to[0] && is_between(from[1], at[1], to[1])) ||
           (from[1] == at[1] && at[1] == to[1] && is_between(from[0], at[0], to[0]));
  }

  /// Stores the triangles that fill the ring of v in ears_; ear number e will replace triangle star_[e]. Returns false
  /// if every solution has an ear that is too thin, or if the given triangles overlap.
  bool cut_ears(std::uint32_t v) {
    ears_.clear();
    if (ring_.size() < 3) return false;
    std::size_t left = ring_.size(), misses = 0;
    std::uint32_t at = 0;
    while (left >= 3) {
      const std::uint32_t before = ring_[at].previous, after = ring_[at].next;
      const std::uint32_t a = ring_[before].start, b = ring_[at].start, c = ring_[after].start;
      const int side = !is_firm(a, b, c) ? -1 : left == 3 ? 1 : orient(a, c, v);
      if (side > 0 || (side == 0 && left == 4)) {
        ears_.push_back({{a, b, c}, {ring_[before].across, ring_[at].across}});
        ring_[before].across = 3 * star_[ears_.size() - 1] + 2;
        ring_[before].next = after;
        ring_[after].previous = before;
        --left;
        misses = 0;
        at = before;
      } else {
        if (++misses > left) return false;
        at = after;
      }
    }
    last_across_ = ring_[ring_[at].next].across;
    return true;
  }

  void replace_star() {
    for (std::size_t e = 0; e < ears_.size(); ++e) {
      const std::uint32_t h = 3 * star_[e];
      for (std::uint32_t k = 0; k < 3; ++k) {
        triangles_[h + k] = ears_[e].corners[k];
        outgoing_[ears_[e].corners[k]] = h + k;
      }
      link(h, ears_[e].across[0]);
      link(h + 1, ears_[e].across[1]);
    }
    link(3 * star_[ears_.size() - 1] + 2, last_across_);
    for (std::size_t e = ears_.size(); e < star_.size(); ++e) {
      triangles_[3 * star_[e] + 1] = triangles_[3 * star_[e]];  // one or two triangles fewer
    }
  }

  void link(std::uint32_t h, std::uint32_t twin) {
    twins_[h] = twin;
    if (twin != kNoHalfEdge) twins_[twin] = h;
  }

  std::span<const double> positions_;
  std::vector<std::uint32_t> triangles_, twins_;
  std::vector<std::uint32_t> outgoing_;  // one half-edge that starts at each vertex
  std::vector<std::uint32_t> degrees_;   // triangles at each vertex
  std::vector<bool> on_border_;
  std::vector<RingEdge> ring_;  // indexed by ring position; a linked list while ears are cut
  std::vector<std::uint32_t> star_;
  std::vector<Ear> ears_;
  std::uint32_t last_across_ = kNoHalfEdge;  // link of the last ear's third edge
};

}  // namespace

std::vector<std::uint32_t> build_flat_base(std::span<const double> positions, std::vector<std::uint32_t> triangles,
                                           std::vector<std::uint32_t> twins) {
  return FlatBase(positions, std::move(triangles), std::move(twins)).build();
}

}  // namespace scarp::mesh
