#include "geom/convex_hull.h"

#include <algorithm>
#include <array>

namespace scarp::geom {

namespace {

/// Extreme points in eight directions, in their order around the hull.
std::array<Point, 8> find_extremes(std::span<const Point> points) {
  constexpr std::array<std::array<std::int64_t, 2>, 8> kDirections{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Point, 8> extremes;
  extremes.fill(points[0]);
  for (const Point p : points) {
    for (std::size_t k = 0; k < 8; ++k) {
      const auto [x, y] = kDirections[k];
      if (x * p.x + y * p.y > x * extremes[k].x + y * extremes[k].y) extremes[k] = p;
    }
  }
  return extremes;
}

bool is_strictly_inside(const std::array<Point, 8>& polygon, Point p) {
  for (std::size_t k = 0; k < 8; ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % 8];
    if (!(a == b) && orient(a, b, p) <= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> convex_hull(std::span<const Point> points) {
  std::vector<std::uint32_t> ids, hull;
  if (points.empty()) return hull;
  const auto extremes = find_extremes(points);
  const bool has_inside = std::any_of(extremes.begin(), extremes.end(), [&](Point p) { return !(p == extremes[0]); });
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!has_inside || !is_strictly_inside(extremes, points[i])) ids.push_back(i);
  }
  std::sort(ids.begin(), ids.end(), [&](std::uint32_t a, std::uint32_t b) { return before(points[a], points[b]); });
  if (ids.size() < 3) return ids;
  const auto extend = [&](std::size_t start, std::uint32_t i) {
    while (hull.size() >= start + 2 && orient(points[hull[hull.size() - 2]], points[hull.back()], points[i]) <= 0)
      hull.pop_back();
    hull.push_back(i);
  };
  for (const std::uint32_t i : ids) extend(0, i);
  const std::size_t first_chain = hull.size() - 1;
  for (auto i = ids.rbegin() + 1; i != ids.rend(); ++i) extend(first_chain, *i);
  hull.pop_back();
  return hull;
}

}  // namespace scarp::geom
