// Random lines: the arranged lines do not cross and remain in place.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "base/int128.h"
#include "geom/arrangement.h"

namespace scarp::arrangement_laws_test {
namespace {

using Edge = geom::Arrangement::Edge;

struct Soup {
  geom::Polylines lines;
  std::vector<geom::Segment> rigid;
  std::int32_t width = 0, height = 0;
};

class Cook {
 public:
  explicit Cook(std::uint32_t seed) : random_(seed) {}

  std::int32_t below(std::int64_t n) { return static_cast<std::int32_t>(random_() % static_cast<std::uint64_t>(n)); }
  bool sometimes(int one_in) { return below(one_in) == 0; }

  Soup cook() {
    Soup soup;
    const std::int32_t kSizes[] = {4, 8, 16, 64, 4096, 1 << 20, kMaxCoordinate - 1};
    soup.width = kSizes[below(7)];
    soup.height = sometimes(3) ? kSizes[below(7)] : soup.width;
    add_rigid(soup);
    for (int count = below(14); count >= 0; --count) add_line(soup);
    return soup;
  }

 private:
  /// Outlines are borders and diagonals of cells.
  void add_rigid(Soup& soup) {
    if (!sometimes(4)) {
      const std::int32_t w = soup.width, h = soup.height;
      for (const geom::Segment& s :
           {geom::Segment{{0, 0}, {w, 0}}, {{w, 0}, {w, h}}, {{w, h}, {0, h}}, {{0, h}, {0, 0}}})
        soup.rigid.push_back(s);
    }
    const std::int32_t kSteps[] = {2, 4, 8}, step = std::min(soup.width, soup.height) / kSteps[below(3)] / 2 * 2;
    if (step == 0) return;
    const std::int32_t cols = soup.width / step, rows = soup.height / step;
    for (int count = below(8); count > 0; --count) {
      const Point from{below(cols + 1), below(rows + 1)};
      Point to = from;
      const int way = below(4);
      for (int length = 1 + below(3); length > 0; --length) {
        const Point next{to.x + (way != 0 ? 1 : 0), to.y + (way == 0 || way == 2 ? 1 : way == 3 ? -1 : 0)};
        if (next.x > cols || next.y > rows || next.y < 0) break;
        to = next;
      }
      if (to != from) soup.rigid.push_back({{from.x * step, from.y * step}, {to.x * step, to.y * step}});
    }
  }

  Point any_point(const Soup& soup, int outside) {
    const auto any = [&](std::int32_t size) {
      if (!sometimes(outside)) return below(std::int64_t{size} + 1);
      const std::int64_t reach = std::min<std::int64_t>(size, 1 << 30);
      return static_cast<std::int32_t>(below(2 * reach) - reach / 2);
    };
    return {any(soup.width), any(soup.height)};
  }

  void add_line(Soup& soup) {
    const int outside = sometimes(3) ? 2 : 1000;
    std::vector<Point> line;
    const std::vector<Point>& given = soup.lines.points;
    switch (below(6)) {
      case 0:  // collinear with each other, back and forth, with repetitions
        for (int k = 0; k < 6; ++k) {
          const std::int32_t at = below(soup.width + std::int64_t{1});
          line.push_back({at, soup.height / 2 + (way_ == 0 ? 0 : way_ * (at - soup.width / 2))});
        }
        if (sometimes(2)) way_ = below(3) - 1;
        break;
      case 1:  // through one point
        for (int k = 0; k < 4; ++k) {
          const Point p = any_point(soup, 1000);
          line.insert(line.end(), {p, {soup.width - p.x, soup.height - p.y}});
        }
        break;
      case 2:  // along existing lines
        for (int k = 0; k < 5 && !given.empty(); ++k)
          line.push_back(given[static_cast<std::size_t>(below(std::ssize(given)))]);
        break;
      case 3: {  // into a corner
        const std::int32_t x = below(soup.width), y = below(soup.height);
        for (int k = 0; k < 8; ++k) line.push_back({x + below(6), y + below(6)});
        break;
      }
      default:
        for (int count = 1 + below(6); count > 0; --count) line.push_back(any_point(soup, outside));
    }
    soup.lines.add(line);
  }

  std::mt19937 random_;
  std::int32_t way_ = 0;
};

bool between(Point a, Point b, Point p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}
bool on(Point a, Point b, Point p) { return orient(a, b, p) == 0 && between(a, b, p); }

/// A pair that breaks law (1), by testing all pairs.
std::string find_crossing(const geom::Arrangement& result) {
  const auto& v = result.vertices;
  for (const Edge& e : result.edges) {
    if (e.a >= e.b) return "an edge is a point or the wrong way round";
    const Point a = v[e.a], b = v[e.b];
    for (std::uint32_t k = 0; k < v.size(); ++k) {
      if (k != e.a && k != e.b && on(a, b, v[k])) return "a vertex lies on an edge";
    }
    for (const Edge& f : result.edges) {
      const Point c = v[f.a], d = v[f.b];
      if (sign_of(orient(a, b, c)) * sign_of(orient(a, b, d)) < 0 &&
          sign_of(orient(c, d, a)) * sign_of(orient(c, d, b)) < 0)
        return "two edges cross";
    }
  }
  return "";
}

/// |doubled distance in each coordinate| <= reach for some point of the segment.
bool is_near(geom::Segment s, Point p, std::int64_t reach) {
  const std::int64_t dx = std::int64_t{s.to.x} - s.from.x, dy = std::int64_t{s.to.y} - s.from.y;
  const Int128 off = 2 * (Int128{dx} * (std::int64_t{p.y} - s.from.y) - Int128{dy} * (std::int64_t{p.x} - s.from.x));
  if ((off < 0 ? -off : off) > Int128{reach} * (std::abs(dx) + std::abs(dy))) return false;
  const auto within = [&](std::int64_t a, std::int64_t b, std::int64_t q) {
    return 2 * std::min(a, b) - reach <= 2 * q && 2 * q <= 2 * std::max(a, b) + reach;
  };
  return within(s.from.x, s.to.x, p.x) && within(s.from.y, s.to.y, p.y);
}

bool is_inside(const Soup& soup, Point p) { return p.x >= 0 && p.y >= 0 && p.x <= soup.width && p.y <= soup.height; }

std::string judge_chains(const Soup& soup, const geom::Arrangement& result) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> lines;
  for (const Edge& e : result.edges) {
    if (e.is_line) lines.insert({e.a, e.b});
    if (!e.is_line && !e.is_rigid) return "an edge of nothing";
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> passed;
  std::vector<std::set<std::pair<std::uint32_t, std::uint32_t>>> stops(soup.lines.size());  // place, vertex
  for (const auto& chain : result.chains) {
    const auto line = soup.lines[chain.line];
    const geom::Arrangement::Stop* last = nullptr;
    const auto all = result.stops_of(chain);
    if (all.size() < 2) return "a chain of one vertex";
    for (const auto& stop : all) {
      const geom::Segment s{line[stop.segment], line[stop.segment + 1]};
      const bool is_cut = !is_inside(soup, s.from) || !is_inside(soup, s.to);
      const Point p = result.vertices[stop.vertex];
      if (!is_inside(soup, p)) return "outside";
      if (!is_near(s, p, is_cut ? 2 : 1)) return "far from its segment";
      const double dx = double(s.to.x) - s.from.x, dy = double(s.to.y) - s.from.y;
      if (std::abs(s.from.x + stop.fraction * dx - p.x) > 2 || std::abs(s.from.y + stop.fraction * dy - p.y) > 2)
        return "the fraction is of another place";
      if (stop.fraction < 0 || stop.fraction > 1) return "a fraction beyond the segment";
      if (last != nullptr) {
        if (std::pair(stop.segment, stop.fraction) < std::pair(last->segment, last->fraction)) return "backwards";
        const auto edge = std::minmax(last->vertex, stop.vertex);
        if (!lines.contains(edge)) return "two stops without an edge";
        passed.insert(edge);
      }
      last = &stop;
      stops[chain.line].insert({stop.segment, stop.vertex});
    }
  }
  if (passed != lines) return "an edge of a line that no chain passes";
  for (std::uint32_t k = 0; k < soup.lines.size(); ++k) {
    const auto line = soup.lines[k];
    for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
      if (line[i] == line[i + 1] || !is_inside(soup, line[i]) || !is_inside(soup, line[i + 1])) continue;
      for (const Point p : {line[i], line[i + 1]}) {
        const auto found = std::lower_bound(result.vertices.begin(), result.vertices.end(), p, before);
        if (found == result.vertices.end() || *found != p) return "a vertex of a line has moved";
      }
      const auto end = static_cast<std::uint32_t>(
          std::lower_bound(result.vertices.begin(), result.vertices.end(), line[i + 1], before) -
          result.vertices.begin());
      if (!stops[k].contains({i, end})) return "a line does not pass its own vertex";
    }
  }
  return "";
}

/// The lattice steps of segments along axes and diagonals, as disjoint intervals on their lines.
std::vector<std::array<std::int64_t, 4>> stretches(const std::vector<geom::Segment>& segments) {
  std::vector<std::array<std::int64_t, 4>> sorted;
  for (geom::Segment s : segments) {
    if (before(s.to, s.from)) std::swap(s.from, s.to);
    const std::int64_t dx = sign_of(s.to.x - s.from.x), dy = sign_of(s.to.y - s.from.y);
    const std::int64_t begin = dy != 0 ? s.from.y : s.from.x, end = dy != 0 ? s.to.y : s.to.x;
    sorted.push_back({3 * dx + dy, dx * s.from.y - dy * s.from.x, begin, end});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::array<std::int64_t, 4>> merged;
  for (const auto& s : sorted) {
    if (!merged.empty() && merged.back()[0] == s[0] && merged.back()[1] == s[1] && s[2] <= merged.back()[3]) {
      merged.back()[3] = std::max(merged.back()[3], s[3]);
    } else {
      merged.push_back(s);
    }
  }
  return merged;
}

std::string judge_rigid(const Soup& soup, const geom::Arrangement& result) {
  std::vector<geom::Segment> found;
  for (const Edge& e : result.edges) {
    const Point a = result.vertices[e.a], b = result.vertices[e.b];
    if (!e.is_rigid) continue;
    if (a.x != b.x && a.y != b.y && std::abs(b.x - a.x) != std::abs(b.y - a.y)) return "a rigid edge is bent";
    found.push_back({a, b});
  }
  return stretches(found) == stretches(soup.rigid) ? "" : "rigid edges are not the rigid segments";
}

geom::Arrangement arrange(const Soup& soup) { return geom::arrange(soup.lines, soup.rigid, soup.width, soup.height); }

RC_GTEST_PROP(arrangement, crosses_nowhere, ()) {
  const Soup soup = Cook(*rc::gen::arbitrary<std::uint32_t>()).cook();
  const geom::Arrangement result = arrange(soup);
  RC_ASSERT(std::is_sorted(result.vertices.begin(), result.vertices.end(), before));
  RC_ASSERT(find_crossing(result) == "");
}

RC_GTEST_PROP(arrangement, chains_stay_near_their_lines, ()) {
  const Soup soup = Cook(*rc::gen::arbitrary<std::uint32_t>()).cook();
  RC_ASSERT(judge_chains(soup, arrange(soup)) == "");
}

RC_GTEST_PROP(arrangement, rigid_segments_do_not_bend, ()) {
  const Soup soup = Cook(*rc::gen::arbitrary<std::uint32_t>()).cook();
  RC_ASSERT(judge_rigid(soup, arrange(soup)) == "");
}

RC_GTEST_PROP(arrangement, arranging_it_again_changes_nothing, ()) {
  Soup soup = Cook(*rc::gen::arbitrary<std::uint32_t>()).cook();
  const geom::Arrangement once = arrange(soup);
  soup.lines = {};
  for (const Edge& e : once.edges) {
    if (e.is_line) soup.lines.add(std::vector{once.vertices[e.b], once.vertices[e.a]});
  }
  const geom::Arrangement twice = arrange(soup);
  RC_ASSERT(twice.is_exact);
  RC_ASSERT(twice.vertices == once.vertices);
  RC_ASSERT(twice.edges == once.edges);
}

RC_GTEST_PROP(arrangement, does_not_depend_on_the_order_or_direction_of_lines, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  Soup soup = Cook(seed).cook();
  const geom::Arrangement once = arrange(soup);
  std::mt19937 random(seed);
  std::vector<std::vector<Point>> shuffled;
  for (std::size_t k = 0; k < soup.lines.size(); ++k) {
    shuffled.emplace_back(soup.lines[k].begin(), soup.lines[k].end());
    if (random() % 2 == 0) std::reverse(shuffled.back().begin(), shuffled.back().end());
  }
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  std::shuffle(soup.rigid.begin(), soup.rigid.end(), random);
  for (geom::Segment& s : soup.rigid) {
    if (random() % 2 == 0) std::swap(s.from, s.to);
  }
  soup.lines = {};
  for (const auto& line : shuffled) soup.lines.add(line);
  const geom::Arrangement again = arrange(soup);
  RC_ASSERT(again.vertices == once.vertices);
  RC_ASSERT(again.edges == once.edges);
}

RC_GTEST_PROP(arrangement, lines_that_cross_in_lattice_points_do_not_move, ()) {
  Cook cook(*rc::gen::arbitrary<std::uint32_t>());
  Soup soup;
  soup.width = soup.height = 128;
  // Axes and diagonals between points of even coordinates.
  for (int count = cook.below(20); count >= 0; --count) {
    const std::int32_t kWays[] = {0, 1, -1}, way = cook.below(4), length = 2 + 2 * cook.below(12);
    const std::int32_t x = 2 * cook.below(20), y = 26 + 2 * cook.below(20);
    const Point to{x + (way == 3 ? 0 : length), y + (way == 3 ? length : kWays[way] * length)};
    soup.lines.add(std::vector<Point>{{x, y}, to});
  }
  const geom::Arrangement result = arrange(soup);
  RC_ASSERT(result.is_exact);
  for (const auto& chain : result.chains) {
    const auto line = soup.lines[chain.line];
    for (const auto& stop : result.stops_of(chain))
      RC_ASSERT(on(line[stop.segment], line[stop.segment + 1], result.vertices[stop.vertex]));
  }
}

TEST(arrangement, a_bow_tie_gets_a_knot) {
  geom::Polylines lines;
  lines.add(std::vector<Point>{{0, 0}, {10, 10}, {10, 0}, {0, 10}, {0, 0}});
  const geom::Arrangement result = geom::arrange(lines, {}, 10, 10);
  EXPECT_EQ(result.vertices.size(), 5u);
  EXPECT_EQ(result.edges.size(), 6u);
  EXPECT_TRUE(result.is_exact);
  ASSERT_EQ(result.chains.size(), 1u);
  EXPECT_EQ(result.stops_of(result.chains[0]).size(), 7u);
  EXPECT_EQ(result.stops_of(result.chains[0])[1].fraction, 0.5);
}

/// The line passes the corners of (1, 1), (4, 2) and (7, 3). The first and the last belong to these squares because
/// rigid segments cross them.
TEST(arrangement, a_bent_piece_is_split_where_a_vertex_lies_on_it) {
  geom::Polylines lines;
  lines.add(std::vector<Point>{{0, 0}, {9, 3}});
  lines.add(std::vector<Point>{{4, 2}, {4, 8}});
  const std::vector<geom::Segment> rigid{{{0, 2}, {2, 0}}, {{6, 4}, {8, 2}}};
  const geom::Arrangement result = geom::arrange(lines, rigid, 10, 10);
  EXPECT_EQ(find_crossing(result), "");
  ASSERT_EQ(result.chains.size(), 2u);
  std::vector<Point> passed;
  for (const auto& stop : result.stops_of(result.chains[0])) passed.push_back(result.vertices[stop.vertex]);
  EXPECT_EQ(passed, (std::vector<Point>{{0, 0}, {1, 1}, {4, 2}, {7, 3}, {9, 3}}));
}

TEST(arrangement, a_line_that_leaves_becomes_several_chains) {
  geom::Polylines lines;
  lines.add(std::vector<Point>{{2, 2}, {2, -8}, {8, -8}, {8, 2}, {8, 2}, {9, 3}});
  lines.add(std::vector<Point>{{-5, -5}, {-1, 20}, {0, 10}});  // touches only the corner
  lines.add(std::vector<Point>{{4, 4}, {4, 4}});
  const geom::Arrangement result = geom::arrange(lines, {}, 10, 10);
  ASSERT_EQ(result.chains.size(), 2u);
  const auto first = result.stops_of(result.chains[0]), second = result.stops_of(result.chains[1]);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(result.vertices[first[1].vertex], (Point{2, 0}));
  EXPECT_EQ(first[1].fraction, 0.2);
  ASSERT_EQ(second.size(), 3u);
  EXPECT_EQ(result.vertices[second[0].vertex], (Point{8, 0}));
  EXPECT_EQ(second[0].segment, 2u);
  EXPECT_EQ(second[0].fraction, 0.8);
  EXPECT_EQ(second[2].segment, 4u);
  EXPECT_EQ(result.edges.size(), 3u);
}

TEST(arrangement, takes_coordinates_as_large_as_they_come) {
  constexpr std::int32_t kLeast = -2147483647 - 1, kMost = 2147483647;
  geom::Polylines lines;
  lines.add(std::vector<Point>{{kLeast, kLeast}, {kMost, kMost}, {kMost, kLeast}, {kLeast, kMost}});
  lines.add(std::vector<Point>{{kLeast, 1}, {kMost, 2}, {kLeast, 3}});
  const geom::Arrangement result = geom::arrange(lines, {}, kMaxCoordinate, kMaxCoordinate);
  EXPECT_EQ(find_crossing(result), "");
  EXPECT_EQ(result.vertices.front(), (Point{0, 0}));
  EXPECT_EQ(result.vertices.back(), (Point{kMaxCoordinate, kMaxCoordinate}));
}

TEST(arrangement, what_lines_share_is_passed_once) {
  constexpr std::uint32_t kLines = 20000;
  constexpr std::int32_t kSize = 1 << 20;
  geom::Polylines lines;
  for (std::int32_t k = 0; k < std::int32_t{kLines}; ++k)
    lines.add(std::vector<Point>{{k, 2 * k}, {kSize / 2 - 3 * k, kSize - 6 * k}});
  const geom::Arrangement result = geom::arrange(lines, {}, kSize, kSize);
  EXPECT_EQ(result.vertices.size(), 2 * kLines);
  EXPECT_EQ(result.edges.size(), 2 * kLines - 1);
  EXPECT_EQ(result.passes.size(), 2 * kLines);
  EXPECT_EQ(result.stretches.size(), kLines);
  ASSERT_EQ(result.chains.size(), kLines);
  const auto stops = result.stops_of(result.chains[kLines - 2]);
  EXPECT_EQ(result.vertices[stops.front().vertex], (Point{kLines - 2, 2 * kLines - 4}));
  EXPECT_EQ(stops.size(), 2 * kLines - 2 * (kLines - 2));
  EXPECT_EQ(stops.back().fraction, 1);
}

TEST(arrangement, thousands_of_lines_may_meet_in_one_point) {
  constexpr std::int32_t kSize = 1 << 20;
  geom::Polylines lines;
  for (std::int32_t k = 0; k < 2000; ++k) lines.add(std::vector<Point>{{k * 500, 0}, {kSize - k * 500, kSize}});
  const geom::Arrangement result = geom::arrange(lines, {}, kSize, kSize);
  EXPECT_TRUE(result.is_exact);
  EXPECT_EQ(result.vertices.size(), 4001u);
  EXPECT_EQ(result.edges.size(), 4000u);
}

}  // namespace
}  // namespace scarp::arrangement_laws_test
