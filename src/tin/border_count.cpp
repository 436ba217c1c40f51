#include "tin/border_count.h"

#include <vector>

#include "base/point.h"

namespace scarp::tin {

namespace {

bool is_border(const Triangulation& tin, HalfEdge h) {
  const HalfEdge twin = tin.twin(h);
  return !tin.is_outside(h / 3) && (twin == kNone || tin.is_outside(twin / 3));
}

/// The border edge that starts at the end of `h`, with the domain on the same side. REQUIRES: is_border(h).
HalfEdge next_on_border(const Triangulation& tin, HalfEdge h) {
  HalfEdge next = Triangulation::next(h);
  while (!is_border(tin, next)) next = Triangulation::next(tin.twin(next));
  return next;
}

}  // namespace

std::uint64_t count_border_triangles(const Triangulation& tin) {
  std::vector<bool> is_seen(3 * tin.triangle_count(), false);
  std::int64_t count = 0;
  for (HalfEdge first = 0; first < 3 * tin.triangle_count(); ++first) {
    if (is_seen[first] || !is_border(tin, first)) continue;
    // An outer loop of n corners adds n - 2 triangles, and a hole n + 2.
    std::int64_t corners = 0, twice_area = 0;
    HalfEdge h = first;
    do {
      is_seen[h] = true;
      const HalfEdge next = next_on_border(tin, h);
      const Point a = tin.point(tin.origin(h)), b = tin.point(tin.origin(next));
      const Point c = tin.point(tin.origin(Triangulation::next(next)));
      corners += orient(a, b, c) == 0 ? 0 : 1;
      twice_area += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
      h = next;
    } while (h != first);
    count += corners + (twice_area > 0 ? -2 : 2);
  }
  return static_cast<std::uint64_t>(count);
}

}  // namespace scarp::tin
