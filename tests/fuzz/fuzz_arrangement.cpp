// Any lines on a small lattice with any outline: nothing crosses, rigid edges are straight, chains follow edges, and a
// second arrangement changes nothing. Bytes: the size, at most a dozen rigid segments, then two for each vertex.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "geom/arrangement.h"

namespace {

using scarp::Point;
using scarp::geom::Arrangement;

constexpr std::size_t kMostBytes = 160;
constexpr std::int32_t kSize = 64;

void require(bool holds) {
  if (!holds) std::abort();
}

/// −32 … 95: a quarter lies outside on each side.
std::int32_t coordinate(std::uint8_t byte) { return byte % 128 - 32; }

scarp::geom::Segment rigid_segment(std::uint8_t place, std::uint8_t way) {
  const std::int32_t x = place % 8 * 8, y = place / 8 % 8 * 8;
  switch (way % 4) {
    case 0:
      return {{x, y}, {x + 8, y}};
    case 1:
      return {{x, y}, {x, y + 8}};
    case 2:
      return {{x, y}, {x + 8, y + 8}};
    default:
      return {{x, y + 8}, {x + 8, y}};
  }
}

int side(Point a, Point b, Point c) {
  const std::int64_t area = scarp::orient(a, b, c);
  return (area > 0) - (area < 0);
}

bool on(Point a, Point b, Point p) {
  return side(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

void judge(const Arrangement& result) {
  const auto& v = result.vertices;
  for (const auto& e : result.edges) {
    const Point a = v[e.a], b = v[e.b];
    if (e.is_rigid) require(a.x == b.x || a.y == b.y || std::abs(b.x - a.x) == std::abs(b.y - a.y));
    for (std::uint32_t k = 0; k < v.size(); ++k) require(k == e.a || k == e.b || !on(a, b, v[k]));
    for (const auto& f : result.edges) {
      const Point c = v[f.a], d = v[f.b];
      require(side(a, b, c) * side(a, b, d) >= 0 || side(c, d, a) * side(c, d, b) >= 0);
    }
  }
  for (const auto& chain : result.chains) {
    const auto stops = result.stops_of(chain);
    for (std::size_t k = 1; k < stops.size(); ++k) {
      const std::uint32_t low = std::min(stops[k - 1].vertex, stops[k].vertex),
                          high = std::max(stops[k - 1].vertex, stops[k].vertex);
      require(std::any_of(result.edges.begin(), result.edges.end(),
                          [=](const auto& e) { return e.a == low && e.b == high && e.is_line; }));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMostBytes) return 0;
  const std::size_t rigid_count = std::min<std::size_t>(data[0] % 13, (size - 1) / 2);
  std::vector<scarp::geom::Segment> rigid;
  for (std::size_t k = 0; k < rigid_count; ++k) rigid.push_back(rigid_segment(data[1 + 2 * k], data[2 + 2 * k]));
  scarp::geom::Polylines lines;
  std::vector<Point> line;
  for (std::size_t k = 1 + 2 * rigid_count; k + 1 < size; k += 2) {
    line.push_back({coordinate(data[k]), coordinate(data[k + 1])});
    if (data[k] < 128) continue;  // the upper half of the bytes ends a line
    lines.add(line);
    line.clear();
  }
  lines.add(line);
  const Arrangement once = arrange(lines, rigid, kSize, kSize);
  judge(once);

  scarp::geom::Polylines again;
  for (const auto& e : once.edges) {
    if (e.is_line) again.add(std::vector<Point>{once.vertices[e.a], once.vertices[e.b]});
  }
  const Arrangement twice = arrange(again, rigid, kSize, kSize);
  require(twice.is_exact && twice.vertices == once.vertices && twice.edges == once.edges);
  return 0;
}
