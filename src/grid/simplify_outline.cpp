// Removes vertices of ragged outlines without losing a sample.
//
// A straight segment may replace the chain between two vertices under two conditions. First, the chain lies within the
// tolerance on the left of the segment, the side of the domain, so that the domain only grows. Second, the area between
// chain and segment contains no other height, so that none is newly enclosed. This also prevents crossings, since a
// chain that crossed a segment would end in that area, on a sample. The path with the fewest segments around a polygon
// is used.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/sort.h"
#include "grid/outline.h"

namespace scarp::grid {

namespace {

constexpr std::size_t kLongestChain = 200;  // vertices replaced by one segment
constexpr int kLinkPatience = 8;            // successive failures before giving up on a longer segment

/// True if the chain lies on or to the left of the segment from its first to its last point, within `tolerance`.
bool hugs_segment(std::span<const Point> chain, double tolerance) {
  const Point a = chain.front(), b = chain.back();
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  for (Point p : chain.subspan(1, chain.size() - 2)) {
    const std::int64_t side = orient(a, b, p), along = dx * (p.x - a.x) + dy * (p.y - a.y);
    const double distance2 = static_cast<double>(side) * static_cast<double>(side) / static_cast<double>(length2);
    if (side < 0 || along < 0 || along > length2 || distance2 > tolerance * tolerance) return false;
  }
  return true;
}

/// True if p is in the closed polygon, by the crossing number. Points on the border are found first.
bool encloses(std::span<const Point> polygon, Point p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const std::int64_t side = orient(a, b, p);
    const bool in_box = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
                        p.y <= std::max(a.y, b.y);
    if (side == 0 && in_box) return true;
    if ((a.y > p.y) != (b.y > p.y) && (side > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

bool on_chain(std::span<const Point> chain, Point p) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Point a = chain[i], b = chain[i + 1];
    const bool in_box = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
                        p.y <= std::max(a.y, b.y);
    if (in_box && orient(a, b, p) == 0) return true;
  }
  return false;
}

/// True if the area between the chain and its closing segment contains no height except those of the chain.
bool area_is_nodata(const Raster& raster, std::span<const Point> chain) {
  Point low = chain[0], high = chain[0];
  for (Point p : chain) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      const Point p{x, y};
      if (raster.is_valid(p) && orient(chain.front(), chain.back(), p) >= 0 && !on_chain(chain, p) &&
          encloses(chain, p))
        return false;
    }
  }
  return true;
}

/// Vertices that occur repeatedly, in raster order.
std::vector<Point> touching_vertices(const Outline& outline) {
  std::vector<Point> all;
  for (const auto& polygon : outline) all.insert(all.end(), polygon.begin(), polygon.end());
  sort_rarely(all, before);
  std::vector<Point> touching;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i] == all[i - 1]) touching.push_back(all[i]);
  }
  return touching;
}

/// The polygon as a path that starts and ends at `corner`.
std::vector<Point> unrolled(const std::vector<Point>& polygon, Point corner) {
  std::vector<Point> path = polygon;
  std::rotate(path.begin(), std::find(path.begin(), path.end(), corner), path.end());
  path.push_back(path.front());
  return path;
}

/// The corners, except the first, of the fewest segments that may replace a closed path. The smallest growth breaks
/// ties.
std::vector<Point> shortest_path(const Raster& raster, const std::vector<Point>& path,
                                 const std::vector<Point>& touching, double tolerance) {
  struct Best {
    std::size_t segments, from;
    std::int64_t growth;  // twice the area
  };
  const std::size_t n = path.size() - 1;
  std::vector<Best> best(path.size(), {path.size(), 0, 0});
  best[0].segments = 0;
  std::vector<Point> chain;
  for (std::size_t i = 0; i < n; ++i) {
    chain.assign(1, path[i]);
    int failures = 0;
    const std::size_t segments = best[i].segments + 1;
    std::int64_t growth = best[i].growth;
    for (std::size_t j = i + 1; j <= n && j - i <= kLongestChain && failures < kLinkPatience; ++j) {
      // A polygon needs three corners.
      if (j == n && segments < 3) break;
      if (j > i + 1 && std::binary_search(touching.begin(), touching.end(), chain.back(), before)) break;
      chain.push_back(path[j]);
      growth += orient(path[i], path[j], path[j - 1]);
      if (std::pair(segments, growth) >= std::pair(best[j].segments, best[j].growth)) continue;
      if (j == i + 1 || (hugs_segment(chain, tolerance) && area_is_nodata(raster, chain))) {
        best[j] = {segments, i, growth};
        failures = 0;
      } else {
        ++failures;
      }
    }
  }
  std::vector<Point> kept;
  for (std::size_t j = n; j > 0; j = best[j].from) kept.push_back(path[j]);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// The path starts at a corner that must stay, or else at one that a first run kept.
std::vector<Point> simplify_polygon(const Raster& raster, const std::vector<Point>& polygon,
                                    const std::vector<Point>& touching, double tolerance) {
  std::vector<Point> simplest = polygon;
  const auto begin_at = [&](Point corner) {
    std::vector<Point> kept = shortest_path(raster, unrolled(polygon, corner), touching, tolerance);
    if (kept.size() >= 3 && kept.size() < simplest.size()) simplest = std::move(kept);
  };
  const auto stays = [&](Point p) { return std::binary_search(touching.begin(), touching.end(), p, before); };
  const auto fixed = std::find_if(polygon.begin(), polygon.end(), stays);
  begin_at(fixed != polygon.end() ? *fixed : polygon.front());
  if (fixed == polygon.end()) begin_at(simplest[simplest.size() / 2]);
  return simplest;
}

}  // namespace

Outline simplify_outline(const Raster& raster, const Outline& outline, double tolerance) {
  const std::vector<Point> touching = touching_vertices(outline);
  Outline simplified;
  for (const auto& polygon : outline) simplified.push_back(simplify_polygon(raster, polygon, touching, tolerance));
  return simplified;
}

}  // namespace scarp::grid
