#include "geom/hot_points.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "base/sort.h"

namespace scarp::geom {
namespace {

std::vector<Box> boxes_of(std::span<const Point> points) {
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const Point p : points) boxes.push_back({p.x, p.y, p.x, p.y});
  return boxes;
}

std::int64_t cross(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) { return ax * by - ay * bx; }

Box box_of(const Segment& s) {
  return {std::min(s.from.x, s.to.x), std::min(s.from.y, s.to.y), std::max(s.from.x, s.to.x),
          std::max(s.from.y, s.to.y)};
}

/// A fast test for segments that may meet the square of a lattice point in a box.
class Reach {
 public:
  explicit Reach(const Segment& s) : from_(s.from), dx_(s.to.x - s.from.x), dy_(s.to.y - s.from.y), box_(box_of(s)) {}

  bool operator()(const Box& box) const {
    if (!overlaps(box, box_)) return false;
    const std::int64_t twice_x = std::int64_t{box.x0} + box.x1 - 2 * std::int64_t{from_.x},
                       twice_y = std::int64_t{box.y0} + box.y1 - 2 * std::int64_t{from_.y};
    return std::abs(cross(dx_, dy_, twice_x, twice_y)) <=
           std::abs(dx_) * (box.y1 - box.y0 + 1) + std::abs(dy_) * (box.x1 - box.x0 + 1);
  }

 private:
  Point from_;
  std::int64_t dx_, dy_;
  Box box_;
};

bool lies_on(Point a, Point b, Point p) {
  return orient(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

}  // namespace

HotPoints::HotPoints(std::vector<Point> points, std::span<const Segment> rigid, bool is_exact)
    : points_(std::move(points)), is_exact_(is_exact), tree_(boxes_of(points_)) {
  for (const Segment& s : rigid) {
    if (is_antidiagonal(s))
      falling_.push_back({s.from.x + s.from.y, std::min(s.from.x, s.to.x), std::max(s.from.x, s.to.x)});
  }
  sort_rarely(falling_, [](const Falling& a, const Falling& b) {
    return std::tie(a.sum, a.first, a.last) < std::tie(b.sum, b.first, b.last);
  });
  std::size_t kept = 0;
  for (const Falling& next : falling_) {
    if (kept > 0 && falling_[kept - 1].sum == next.sum && next.first <= falling_[kept - 1].last) {
      falling_[kept - 1].last = std::max(falling_[kept - 1].last, next.last);
    } else {
      falling_[kept++] = next;
    }
  }
  falling_.resize(kept);
}

bool HotPoints::lies_on_falling_rigid(Point p) const {
  const auto behind = std::upper_bound(falling_.begin(), falling_.end(), p, [](Point q, const Falling& s) {
    return q.x + q.y != s.sum ? q.x + q.y < s.sum : q.x < s.first;
  });
  return behind != falling_.begin() && std::prev(behind)->sum == p.x + p.y && p.x <= std::prev(behind)->last;
}

/// After doubling, a square reaches from −1 to 1 around its point. The segment's line passes that point at a distance
/// of 2·|cross| / |d|, and the square's extent across the line is (|dx| + |dy|) / |d|. Coordinates of ends are even and
/// those of borders odd, so a segment that meets a square but not its interior touches a corner. Reach ensures that the
/// point lies in the segment's box, so the segment does not end before the square.
HotPoints::Meets HotPoints::meets(const Segment& segment, std::uint32_t point) const {
  const Point p = points_[point];
  const std::int64_t dx = segment.to.x - segment.from.x, dy = segment.to.y - segment.from.y;
  const std::int64_t off = 2 * cross(dx, dy, p.x - segment.from.x, p.y - segment.from.y),
                     reach = std::abs(dx) + std::abs(dy);
  if (std::abs(off) > reach) return Meets::kNo;
  if (std::abs(off) < reach) return Meets::kSquare;
  bool is_its_own = false;
  if (off - dx + dy == 0)  // lower left
    is_its_own = !(lies_on_falling_rigid({p.x - 1, p.y}) && lies_on_falling_rigid({p.x, p.y - 1}));
  else if (off - dx - dy == 0)  // lower right
    is_its_own = lies_on_falling_rigid(p) && lies_on_falling_rigid({p.x + 1, p.y - 1});
  return is_its_own ? Meets::kSquare : Meets::kCorner;
}

void HotPoints::add_candidate(const Segment& segment, bool only_on, std::uint32_t point,
                              std::vector<Candidate>& candidates) const {
  const Point p = points_[point];
  const auto [from, to] = segment;
  if (only_on && orient(from, to, p) != 0) return;
  const Meets how = only_on ? Meets::kSquare : meets(segment, point);
  if (how == Meets::kNo) return;
  const std::int64_t along =
      std::int64_t{to.x - from.x} * (p.x - from.x) + std::int64_t{to.y - from.y} * (p.y - from.y);
  candidates.push_back({along, point, how == Meets::kSquare});
}

void HotPoints::pass(std::vector<Candidate>& candidates, Passes& passes) const {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.along, b.is_passed, a.point) < std::tie(b.along, a.is_passed, b.point);
  });
  for (std::size_t k = 0, last = 0; k < candidates.size(); ++k) {
    if (!candidates[k].is_passed) continue;
    for (std::size_t corner = last + 1; corner < k; ++corner) {
      if (lies_on(points_[candidates[last].point], points_[candidates[k].point], points_[candidates[corner].point]))
        passes.points.push_back(candidates[corner].point);
    }
    passes.points.push_back(candidates[k].point);
    last = k;
  }
  passes.begins.push_back(passes.points.size());
}

HotPoints::Passes HotPoints::walk(std::span<const Segment> segments, bool are_rigid) const {
  constexpr std::size_t kTogether = 8, kMostGathered = 64;
  const bool only_on = are_rigid || is_exact_;
  Passes passes;
  passes.begins.reserve(segments.size() + 1);
  passes.points.reserve(3 * segments.size());
  std::vector<std::size_t> near;
  std::vector<Candidate> candidates;
  for (std::size_t begin = 0; begin < segments.size(); begin += kTogether) {
    const auto group = segments.subspan(begin, std::min(kTogether, segments.size() - begin));
    Box hull = box_of(group[0]);
    for (const Segment& s : group) hull = hull_of(hull, box_of(s));
    const bool is_near = tree_.gather(hull, 0, kMostGathered, near);
    for (const Segment& s : group) {
      candidates.clear();
      const Box box = box_of(s);
      if (is_near) {
        for (const std::size_t place : near) {
          if (overlaps(box, tree_.box_at(place))) add_candidate(s, only_on, tree_.order()[place], candidates);
        }
      } else {
        tree_.visit(Reach(s), [&](std::uint32_t point) { add_candidate(s, only_on, point, candidates); });
      }
      pass(candidates, passes);
    }
  }
  return passes;
}

}  // namespace scarp::geom
