// Arrangement and triangulation against CGAL's exact constrained Delaunay triangulation.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "geom/arrangement.h"
#include "lines/constraints.h"

namespace scarp {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Peer = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_intersections_tag>;
using Segments = std::vector<std::array<std::int32_t, 4>>;

Peer::Point to_peer(Point p) { return {p.x, p.y}; }
/// REQUIRES: a lattice point.
Point from_peer(const Peer::Point& p) {
  const auto whole = [](const auto& value) { return static_cast<std::int32_t>(CGAL::to_double(CGAL::exact(value))); };
  return {whole(p.x()), whole(p.y())};
}

void add(Segments& segments, Point a, Point b) {
  if (before(b, a)) std::swap(a, b);
  segments.push_back({a.x, a.y, b.x, b.y});
}
/// Sorted, without duplicates.
Segments tidy(Segments segments) {
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

Segments line_edges(const geom::Arrangement& arranged) {
  Segments edges;
  for (const auto& e : arranged.edges) {
    if (e.is_line) add(edges, arranged.vertices[e.a], arranged.vertices[e.b]);
  }
  return tidy(edges);
}
Segments constrained_edges(const tin::Triangulation& tin) {
  Segments edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.is_constrained(h)) add(edges, tin.point(tin.origin(h)), tin.point(tin.origin(tin::Triangulation::next(h))));
  }
  return tidy(edges);
}
Segments constrained_edges(const Peer& peer) {
  Segments edges;
  for (const auto& edge : peer.constrained_edges()) {
    add(edges, from_peer(edge.first->vertex(Peer::cw(edge.second))->point()),
        from_peer(edge.first->vertex(Peer::ccw(edge.second))->point()));
  }
  return tidy(edges);
}

/// Triangles of either library.
struct Faces {
  static constexpr std::size_t kNowhere = ~std::size_t{0};
  struct Side {
    std::size_t beyond;  ///< a triangle, or kNowhere
    bool is_constrained;
  };
  std::vector<std::array<Side, 3>> sides;
  std::vector<std::int64_t> areas;  ///< doubled

  /// The areas behind 0, 1, 2, … constrained edges, seen from outside.
  std::vector<std::int64_t> areas_by_depth() const {
    std::vector<bool> is_seen(sides.size(), false);
    std::vector<std::size_t> here, behind;
    for (std::size_t t = 0; t < sides.size(); ++t) {
      for (const Side& side : sides[t]) {
        if (side.beyond == kNowhere) (side.is_constrained ? behind : here).push_back(t);
      }
    }
    std::vector<std::int64_t> result;
    while (!here.empty() || !behind.empty()) {
      std::int64_t area = 0;
      while (!here.empty()) {
        const std::size_t t = here.back();
        here.pop_back();
        if (is_seen[t]) continue;
        is_seen[t] = true;
        area += areas[t];
        for (const Side& side : sides[t]) {
          if (side.beyond != kNowhere) (side.is_constrained ? behind : here).push_back(side.beyond);
        }
      }
      result.push_back(area);
      here.swap(behind);
    }
    while (!result.empty() && result.back() == 0) result.pop_back();
    return result;
  }
};

Faces faces_of(const tin::Triangulation& tin) {
  Faces faces;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    std::array<Faces::Side, 3> sides{};
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h)
      sides[h % 3] = {tin.twin(h) == tin::kNone ? Faces::kNowhere : tin.twin(h) / 3, tin.is_constrained(h)};
    faces.sides.push_back(sides);
    const auto [a, b, c] = tin.corners(t);
    faces.areas.push_back(orient(a, b, c));
  }
  return faces;
}
Faces faces_of(const Peer& peer) {
  std::map<Peer::Face_handle, std::size_t> numbers;
  for (const auto& face : peer.finite_face_handles()) numbers.emplace(face, numbers.size());
  Faces faces;
  faces.sides.resize(numbers.size());
  faces.areas.resize(numbers.size());
  for (const auto& [face, number] : numbers) {
    std::array<Point, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = from_peer(face->vertex(k)->point());
      const auto beyond = numbers.find(face->neighbor(k));
      faces.sides[number][static_cast<std::size_t>(k)] = {beyond == numbers.end() ? Faces::kNowhere : beyond->second,
                                                          face->is_constrained(k)};
    }
    faces.areas[number] = orient(corners[0], corners[1], corners[2]);
  }
  return faces;
}

/// Lines and rings in a raster, in steps.
struct Soup {
  std::int32_t cols = 0, rows = 0;
  geom::Polylines lines;
  std::vector<Point> samples;  ///< vertices inserted before lines

  std::int32_t width() const { return (cols - 1) * grid::kLatticeSteps; }
  std::int32_t height() const { return (rows - 1) * grid::kLatticeSteps; }
  geom::Arrangement arrange() const {
    const Point a{0, 0}, b{width(), 0}, c{width(), height()}, d{0, height()};
    return geom::arrange(lines, std::vector<geom::Segment>{{a, b}, {b, c}, {c, d}, {d, a}}, width(), height());
  }
};

Soup any_soup() {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto below = [&](std::int32_t n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  Soup soup{2 + below(12), 2 + below(12), {}, {}};
  const std::int32_t kGrains[] = {1, 16, grid::kLatticeSteps / 2, grid::kLatticeSteps};
  for (int count = 1 + below(6); count > 0; --count) {
    std::vector<Point> line;
    const std::int32_t grain = kGrains[below(4)];
    for (int k = 2 + below(6); k > 0; --k)
      line.push_back({below(soup.width() / grain + 1) * grain, below(soup.height() / grain + 1) * grain});
    if (below(2) == 0) line.push_back(line.front());
    soup.lines.add(line);
  }
  for (int count = below(20); count > 0; --count) soup.samples.push_back({below(soup.cols), below(soup.rows)});
  return soup;
}

RC_GTEST_PROP(cgal, lines_that_cross_in_lattice_points_are_cut_as_cgal_cuts_them, ()) {
  const Soup soup = any_soup();
  const geom::Arrangement arranged = soup.arrange();
  RC_PRE(arranged.is_exact);
  Peer peer;
  for (std::size_t k = 0; k < soup.lines.size(); ++k) {
    const auto line = soup.lines[k];
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i - 1] != line[i]) peer.insert_constraint(to_peer(line[i - 1]), to_peer(line[i]));
    }
  }
  RC_ASSERT(constrained_edges(peer) == line_edges(arranged));
}

RC_GTEST_PROP(cgal, a_constrained_triangulation_holds_the_edges_and_areas_of_cgals, ()) {
  const Soup soup = any_soup();
  const geom::Arrangement arranged = soup.arrange();
  lines::ConstraintGraph graph;
  graph.points = arranged.vertices;
  graph.heights.assign(graph.points.size(), 0);
  for (const auto& e : arranged.edges) {
    if (e.is_line) graph.edges.push_back({e.a, e.b});
  }
  const std::vector<float> heights(static_cast<std::size_t>(soup.cols) * static_cast<std::size_t>(soup.rows), 0.0F);
  tin::Triangulation tin(soup.cols, soup.rows);
  for (const Point p : soup.samples) tin.insert(p, tin.locate(p, tin.last_touched()));
  RC_ASSERT(lines::ConstrainedMesh::insert({heights.data(), soup.cols, soup.rows}, tin, graph).has_value());

  Peer peer;
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) peer.insert(to_peer(tin.point(v)));
  for (const auto& [a, b] : graph.edges) peer.insert_constraint(to_peer(graph.points[a]), to_peer(graph.points[b]));
  RC_ASSERT(peer.number_of_vertices() == tin.vertex_count());  // nothing remained to cut
  RC_ASSERT(constrained_edges(tin) == constrained_edges(peer));
  const Faces ours = faces_of(tin), theirs = faces_of(peer);
  RC_ASSERT(ours.areas.size() == theirs.areas.size());
  RC_ASSERT(ours.areas_by_depth() == theirs.areas_by_depth());

  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.is_constrained(h) || tin.twin(h) == tin::kNone) continue;
    const auto [a, b, c] = tin.corners(h / 3);
    const Point d = tin.point(tin.origin(tin::Triangulation::previous(tin.twin(h))));
    RC_ASSERT(CGAL::side_of_oriented_circle(to_peer(a), to_peer(b), to_peer(c), to_peer(d)) != CGAL::ON_POSITIVE_SIDE);
  }
}

}  // namespace
}  // namespace scarp
