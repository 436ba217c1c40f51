#include "measure/hull_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/sort.h"

namespace scarp::judge {
namespace {

struct Spot {
  double x = 0, y = 0;
};

double turn(const Spot& a, const Spot& b, const Spot& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Omits spots that cannot be corners of the hull, since they are well inside the octagon of the outermost spots.
template <class SpotOf>
std::vector<Spot> find_outer(std::size_t count, const SpotOf& spot) {
  if (count == 1) return {spot(0)};
  constexpr std::array<std::array<double, 2>, 8> kWays{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Spot, 8> outermost;
  outermost.fill(spot(0));
  for (std::size_t i = 0; i < count; ++i) {
    const Spot p = spot(i);
    for (std::size_t k = 0; k < kWays.size(); ++k) {
      const auto [x, y] = kWays[k];
      if (x * p.x + y * p.y > x * outermost[k].x + y * outermost[k].y) outermost[k] = p;
    }
  }
  const double hair = 1e-9 * (outermost[0].x - outermost[4].x) * (outermost[2].y - outermost[6].y);
  const auto is_outer = [&](const Spot& p) {
    for (std::size_t k = 0; k < 8; ++k) {
      const Spot &a = outermost[k], &b = outermost[(k + 1) % 8];
      if ((a.x != b.x || a.y != b.y) && !(turn(a, b, p) > hair)) return true;
    }
    return false;
  };
  std::vector<Spot> outer;
  for (std::size_t i = 0; i < count; ++i) {
    if (const Spot p = spot(i); is_outer(p)) outer.push_back(p);
  }
  return outer;
}

void sort_spots(std::vector<Spot>& spots) {
  sort_rarely(spots, [](const Spot& a, const Spot& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
}

/// The lower or the upper chain of the hull, from west to east; `sign` 1 or −1.
std::vector<Spot> chain_of(const std::vector<Spot>& sorted, double sign) {
  std::vector<Spot> chain;
  for (const Spot& p : sorted) {
    while (chain.size() >= 2 && sign * turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
    chain.push_back(p);
  }
  return chain;
}

/// Distance of p from the chain towards the inside; negative outside.
double depth(const std::vector<Spot>& chain, double sign, const Spot& p) {
  const auto after = std::upper_bound(chain.begin(), chain.end(), p.x, [](double x, const Spot& s) { return x < s.x; });
  if (after == chain.begin() || after == chain.end()) return -HUGE_VAL;
  const Spot &a = *(after - 1), &b = *after;
  return sign * turn(a, b, p) / std::hypot(b.x - a.x, b.y - a.y);
}

/// Counts the open edges for which is_inside(a place outside their middle).
template <class IsInside>
std::uint64_t count_edges(const Mesh& mesh, std::span<const OpenEdge> open, double tolerance,
                          const IsInside& is_inside) {
  const double noise = position_noise(mesh), far = std::max(4 * tolerance, 4 * noise);
  std::uint64_t count = 0;
  for (const OpenEdge& edge : open) {
    const auto at = [&](std::uint32_t v) {
      return Spot{mesh.positions[3 * std::size_t{v}], mesh.positions[3 * std::size_t{v} + 1]};
    };
    const Spot a = at(edge.from), b = at(edge.to);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    // Triangles lie to the left of their edges.
    const auto is_inside_at = [&](double step) {
      return is_inside(
          Spot{(a.x + b.x) / 2 + step * (b.y - a.y) / length, (a.y + b.y) / 2 - step * (b.x - a.x) / length});
    };
    // From a short edge near the corner of a narrow hole, the far place lies across the hole.
    count += is_inside_at(far) && is_inside_at(std::max(std::min(far, length / 16), 4 * noise));
  }
  return count;
}

}  // namespace

PointSet hull_corners(const PointSet& points) {
  std::vector<Spot> spots = find_outer(points.size(), [&](std::size_t i) { return Spot{points.x[i], points.y[i]}; });
  sort_spots(spots);
  PointSet corners;
  const auto add = [&](std::span<const Spot> chain) {
    for (const Spot& corner : chain) {
      corners.x.push_back(corner.x);
      corners.y.push_back(corner.y);
      corners.z.push_back(0);
    }
  };
  add(chain_of(spots, 1));
  if (const std::vector<Spot> upper = chain_of(spots, -1); upper.size() > 2)
    add(std::span(upper).subspan(1, upper.size() - 2));
  return corners;
}

std::uint64_t count_hull_gaps(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
                              std::span<const OpenEdge> open, double tolerance) {
  if (open.empty() || snapped.size() == 0) return 0;
  std::vector<Spot> spots = find_outer(snapped.size(), [&](std::size_t i) {
    const std::uint32_t source = snapped.source[i];
    return Spot{points.x[source] - mesh.origin[0], points.y[source] - mesh.origin[1]};
  });
  sort_spots(spots);
  const auto lower = chain_of(spots, 1), upper = chain_of(spots, -1);
  return count_edges(mesh, open, tolerance,
                     [&](const Spot& beside) { return depth(lower, 1, beside) > 0 && depth(upper, -1, beside) > 0; });
}

std::uint64_t count_boundary_gaps(const std::vector<PlaceRing>& rings, const Mesh& mesh, std::span<const OpenEdge> open,
                                  double tolerance) {
  const RingBands bands(rings);
  return count_edges(mesh, open, tolerance, [&](const Spot& beside) {
    return bands.holds(beside.x + mesh.origin[0], beside.y + mesh.origin[1]);
  });
}

}  // namespace scarp::judge
