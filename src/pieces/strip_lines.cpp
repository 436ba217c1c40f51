#include "pieces/strip_lines.h"

#include <algorithm>
#include <numeric>

#include "base/function_ref.h"
#include "base/sort.h"
#include "grid/vertex_lattice.h"

namespace scarp::pieces {

namespace {

using Ends = std::array<Point, 2>;

std::int32_t upper_of(const Ends& ends) { return std::min(ends[0].y, ends[1].y); }

template <class Edge, class EndsOf>
void sort_by_upper_ends(std::vector<Edge>& edges, const EndsOf& ends_of) {
  sort_rarely(edges, [&](const Edge& a, const Edge& b) { return upper_of(ends_of(a)) < upper_of(ends_of(b)); });
}

/// Calls visit(edge) for edges within the rows [top, bottom].
template <class Edge, class EndsOf, class Visit>
void visit_within(const std::vector<Edge>& edges, std::int32_t top, std::int32_t bottom, const EndsOf& ends_of,
                  const Visit& visit) {
  auto edge =
      std::partition_point(edges.begin(), edges.end(), [&](const Edge& e) { return upper_of(ends_of(e)) < top; });
  for (; edge != edges.end() && upper_of(ends_of(*edge)) <= bottom; ++edge) {
    const Ends ends = ends_of(*edge);
    if (std::max(ends[0].y, ends[1].y) <= bottom) visit(*edge);
  }
}

const Ends& as_ends(const Ends& edge) { return edge; }

}  // namespace

StripLines::StripLines(const lines::ConstraintGraph& graph)
    : graph_(graph), points_(graph.points.size()), edges_(graph.edges.size()) {
  std::iota(points_.begin(), points_.end(), 0u);
  sort_rarely(points_, [&](std::uint32_t a, std::uint32_t b) { return before(graph_.points[a], graph_.points[b]); });
  const auto upper_end = [&](std::uint32_t edge) {
    return std::min(graph_.points[graph_.edges[edge][0]].y, graph_.points[graph_.edges[edge][1]].y);
  };
  std::iota(edges_.begin(), edges_.end(), 0u);
  sort_rarely(edges_, [&](std::uint32_t a, std::uint32_t b) { return upper_end(a) < upper_end(b); });
  if (!graph.cut) return;
  walls_ = graph.cut->walls;
  outline_ = graph.cut->outline;
  sort_by_upper_ends(walls_, [&](const auto& wall) { return Ends{graph.points[wall[0]], graph.points[wall[1]]}; });
  sort_by_upper_ends(outline_, as_ends);
}

/// True if lines have points on rows of samples, both included.
bool StripLines::has_points(std::int32_t top, std::int32_t bottom) const {
  const auto first = std::partition_point(points_.begin(), points_.end(),
                                          [&](auto p) { return graph_.points[p].y < top * grid::kLatticeSteps; });
  return first != points_.end() && graph_.points[*first].y <= bottom * grid::kLatticeSteps;
}

bool StripLines::makes_whole(std::int32_t first, std::int32_t rows) const {
  return graph_.is_inserted_first && has_points(first, first + rows - 1);
}

lines::ConstraintGraph StripLines::part_of(const Piece& strip) const {
  const std::int32_t top = strip.first * grid::kLatticeSteps,
                     bottom = top + (strip.samples.rows - 1) * grid::kLatticeSteps;
  lines::ConstraintGraph part;
  std::vector<std::uint32_t> numbers;  // indices of points_[first + k]
  const auto row_of = [&](std::uint32_t point) { return graph_.points[point].y; };
  const auto first = std::partition_point(points_.begin(), points_.end(), [&](auto p) { return row_of(p) < top; });
  const auto last = std::partition_point(first, points_.end(), [&](auto p) { return row_of(p) <= bottom; });
  for (auto p = first; p != last; ++p) {
    const Point at = graph_.points[*p];
    part.points.push_back({at.x, at.y - top});
    part.heights.push_back(graph_.heights[*p]);
    part.is_shared.push_back((at.y == top && strip.has_above) || (at.y == bottom && strip.has_below) ? 1 : 0);
  }
  const auto number_of = [&](std::uint32_t point) {
    const Point at = graph_.points[point];
    const auto found =
        std::lower_bound(first, last, at, [&](std::uint32_t p, Point to) { return before(graph_.points[p], to); });
    return static_cast<std::uint32_t>(found - first);
  };
  const auto upper_end = [&](std::uint32_t edge) {
    return std::min(row_of(graph_.edges[edge][0]), row_of(graph_.edges[edge][1]));
  };
  auto edge = std::partition_point(edges_.begin(), edges_.end(), [&](auto e) { return upper_end(e) < top; });
  for (; edge != edges_.end() && upper_end(*edge) <= bottom; ++edge) {
    const auto [a, b] = graph_.edges[*edge];
    if (std::max(row_of(a), row_of(b)) > bottom) continue;
    part.edges.push_back({number_of(a), number_of(b)});
    if (!graph_.is_start.empty()) part.is_start.push_back(graph_.is_start[*edge]);
  }
  part.cut = part_of_cut(strip.first, strip.samples.rows, number_of);
  return part;
}

std::optional<lines::SurfaceCut> StripLines::part_of_cut(std::int32_t first, std::int32_t rows,
                                                         FunctionRef<std::uint32_t(std::uint32_t)> number_of) const {
  if (!graph_.cut) return std::nullopt;
  const std::int32_t top = first * grid::kLatticeSteps, bottom = top + (rows - 1) * grid::kLatticeSteps;
  lines::SurfaceCut part;
  part.rows = graph_.cut->rows;
  part.first = first;
  visit_within(
      walls_, top, bottom,
      [&](const auto& wall) {
        return Ends{graph_.points[wall[0]], graph_.points[wall[1]]};
      },
      [&](const auto& wall) {
        part.walls.push_back({number_of(wall[0]), number_of(wall[1])});
      });
  visit_within(outline_, top, bottom, as_ends, [&](const Ends& edge) {
    part.outline.push_back({Point{edge[0].x, edge[0].y - top}, Point{edge[1].x, edge[1].y - top}});
  });
  return part;
}

}  // namespace scarp::pieces
