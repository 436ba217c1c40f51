#include "pieces/row_cut.h"

#include <algorithm>

#include "grid/vertex_places.h"

namespace scarp {

namespace {

using Ends = std::array<Point, 2>;

std::int32_t upper_of(const Ends& ends) { return std::min(ends[0].y, ends[1].y); }

template <class Edge, class EndsOf>
void sort_by_upper_ends(std::vector<Edge>& edges, const EndsOf& ends_of) {
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const Edge& a, const Edge& b) { return upper_of(ends_of(a)) < upper_of(ends_of(b)); });
}

/// Calls visit(edge) for those that lie in the rows [top, bottom].
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

RowCut::RowCut(const ConstraintGraph& graph) : graph_(graph) {
  if (!graph.cut) return;
  walls_ = graph.cut->walls;
  outline_ = graph.cut->outline;
  sort_by_upper_ends(walls_, [&](const auto& wall) { return Ends{graph.points[wall[0]], graph.points[wall[1]]}; });
  sort_by_upper_ends(outline_, as_ends);
}

std::optional<SurfaceCut> RowCut::part_of(std::int32_t first, std::int32_t rows,
                                          const std::function<std::uint32_t(std::uint32_t)>& number_of) const {
  if (!graph_.cut) return std::nullopt;
  const std::int32_t top = first * kLatticeSteps, bottom = top + (rows - 1) * kLatticeSteps;
  SurfaceCut part;
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

}  // namespace scarp
