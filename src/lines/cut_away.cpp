#include "lines/cut_away.h"

#include <algorithm>
#include <utility>

#include "base/int128.h"
#include "grid/vertex_lattice.h"

namespace scarp::lines {

namespace {

class CutAway {
 public:
  CutAway(tin::Triangulation& tin, const SurfaceCut& cut)
      : tin_(tin), cut_(cut), walls_(3 * tin.triangle_count(), Wall::kNo) {
    first_.assign(tin.vertex_count(), tin::kNone);
    for (tin::HalfEdge h = 0; h < walls_.size(); ++h) first_[tin.origin(h)] = h;
  }

  /// Marks the edges from a to b, which are collinear.
  void add_wall(tin::Vertex a, tin::Vertex b) {
    for (tin::Vertex v = a; v != b;) {
      const tin::HalfEdge h = edge_towards(v, tin_.point(b));
      mark(h, v);
      v = tin_.origin(h) == v ? tin_.origin(tin::Triangulation::next(h)) : tin_.origin(h);
    }
  }

  /// True if something remains.
  bool run() {
    std::vector<bool> is_seen(tin_.triangle_count(), false);
    bool any = false;
    for (tin::Triangle t = 0; t < tin_.triangle_count(); ++t) {
      if (is_seen[t] || tin_.is_outside(t)) continue;
      collect_part(t, is_seen);
      if (stays()) {
        any = true;
        continue;
      }
      for (const tin::Triangle gone : part_) tin_.set_outside(gone, true);
    }
    return any;
  }

 private:
  /// Kind of a half-edge: no wall, or the side of a wall on which its triangle lies.
  enum class Wall : std::uint8_t { kNo, kBeyond, kWithin };

  void mark(tin::HalfEdge h, tin::Vertex from) {
    const bool runs_on = tin_.origin(h) == from;
    walls_[h] = runs_on ? Wall::kWithin : Wall::kBeyond;
    if (tin_.twin(h) != tin::kNone) walls_[tin_.twin(h)] = runs_on ? Wall::kBeyond : Wall::kWithin;
  }

  bool leads_towards(tin::Vertex v, tin::Vertex other, Point target) const {
    const Point p = tin_.point(v), q = tin_.point(other);
    if (orient(p, target, q) != 0) return false;
    return std::int64_t{target.x - p.x} * (q.x - p.x) + std::int64_t{target.y - p.y} * (q.y - p.y) > 0;
  }

  /// The half-edge from v towards the target; if it has no triangle, its opposite half-edge.
  tin::HalfEdge edge_towards(tin::Vertex v, Point target) const {
    const tin::HalfEdge first = first_[v];
    tin::HalfEdge h = first;
    do {
      if (leads_towards(v, tin_.origin(tin::Triangulation::next(h)), target)) return h;
      const tin::HalfEdge before = tin::Triangulation::previous(h);
      if (tin_.twin(before) == tin::kNone && leads_towards(v, tin_.origin(before), target)) return before;
      h = tin_.twin(before);
    } while (h != tin::kNone && h != first);
    for (h = tin_.twin(first); h != tin::kNone; h = tin_.twin(tin::Triangulation::next(h))) {
      const tin::HalfEdge out = tin::Triangulation::next(h);
      if (leads_towards(v, tin_.origin(tin::Triangulation::next(out)), target)) return out;
    }
    return tin::kNone;
  }

  /// Collects triangles of the domain that no wall separates from t.
  void collect_part(tin::Triangle t, std::vector<bool>& is_seen) {
    part_.assign(1, t);
    is_seen[t] = true;
    verdict_ = Wall::kNo;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      for (tin::HalfEdge h = 3 * part_[i]; h < 3 * part_[i] + 3; ++h) {
        if (walls_[h] != Wall::kNo) {
          verdict_ = walls_[h];
          continue;
        }
        const tin::HalfEdge g = tin_.twin(h);
        if (g == tin::kNone || is_seen[g / 3] || tin_.is_outside(g / 3)) continue;
        is_seen[g / 3] = true;
        part_.push_back(g / 3);
      }
    }
  }

  /// True if the part remains. Its walls decide; without walls, a sample in it that is on no wall decides, or else a
  /// triangle.
  bool stays() const {
    if (verdict_ != Wall::kNo) return verdict_ == Wall::kWithin;
    for (const tin::Triangle t : part_) {
      for (const Point p : tin_.corners(t)) {
        if (p.x % grid::kLatticeSteps != 0 || p.y % grid::kLatticeSteps != 0) continue;
        const grid::CutSide side = cut_.rows->side({p.x / grid::kLatticeSteps, cut_.first + p.y / grid::kLatticeSteps});
        if (side != grid::CutSide::kOnWall) return side == grid::CutSide::kWithin;
      }
    }
    return holds_centre(part_.front());
  }

  /// Counts outline edges to the left of the triangle's centre; an odd count means inside.
  bool holds_centre(tin::Triangle t) const {
    const auto [a, b, c] = tin_.corners(t);
    const Int128 x = Int128{a.x} + b.x + c.x, y = Int128{a.y} + b.y + c.y;
    bool is_within = false;
    for (auto [p, q] : cut_.outline) {
      if (p.y > q.y) std::swap(p, q);
      if (Int128{3} * p.y > y || Int128{3} * q.y <= y) continue;
      // An edge is left of the centre if it runs down the rows and the centre is on its negative side.
      const Int128 side = (Int128{q.x} - p.x) * (y - Int128{3} * p.y) - (Int128{q.y} - p.y) * (x - Int128{3} * p.x);
      is_within = is_within != (side < 0);
    }
    return is_within;
  }

  tin::Triangulation& tin_;
  const SurfaceCut& cut_;
  std::vector<Wall> walls_;           // by half-edge
  std::vector<tin::HalfEdge> first_;  // by vertex, one that starts there
  std::vector<tin::Triangle> part_;
  Wall verdict_ = Wall::kNo;  // side of a wall on which the part lies
};

}  // namespace

bool cut_away(tin::Triangulation& tin, const SurfaceCut& cut, std::span<const tin::Vertex> vertices) {
  CutAway away(tin, cut);
  for (const auto& [a, b] : cut.walls) {
    if (vertices[a] != tin::kNone && vertices[b] != tin::kNone) away.add_wall(vertices[a], vertices[b]);
  }
  return away.run();
}

}  // namespace scarp::lines
