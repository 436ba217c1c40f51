// Sizes, the longest edges allowed at each vertex, that grow slowly (Persson 2006, "Mesh size functions for implicit
// geometries and PDE-based gradient limiting"; here on the graph of the mesh itself).
#pragma once

#include <vector>

#include "shape/plan_metric.h"
#include "tin/triangulation.h"

namespace scarp::shape {

/// The size at a vertex is the least s + grade·d over all vertices, where s is the length of such a vertex's shortest
/// edge and d is its distance along edges. Sizes only fall while a mesh grows: edges that were flipped away also count.
class SizeField {
 public:
  /// Borrows `tin` and `metric`. Lengths below `least` count as `least`.
  SizeField(const tin::Triangulation& tin, const PlanMetric& metric, double grade, double least)
      : tin_(tin), metric_(metric), grade_(grade), least_(least) {}

  /// Measures the sizes of all vertices. `out`: a half-edge out of each one.
  void measure_all(const std::vector<tin::HalfEdge>& out);
  /// Updates sizes after an insertion; `changed`: the triangles around the new vertex. Appends each vertex whose size
  /// fell to `fallen`, once.
  void update(const std::vector<tin::Triangle>& changed, const std::vector<tin::HalfEdge>& out,
              std::vector<tin::Vertex>& fallen);

  double at(tin::Vertex v) const { return sizes_[v]; }

 private:
  static constexpr std::uint8_t kWaits = 1, kFell = 2;

  void take_lengths(tin::Triangle t);
  void lower(tin::Vertex v, double size);
  void spread(const std::vector<tin::HalfEdge>& out, std::vector<tin::Vertex>* fallen);
  double length(tin::Vertex v, tin::Vertex w) const;

  const tin::Triangulation& tin_;
  const PlanMetric& metric_;
  double grade_, least_;
  std::vector<double> sizes_;
  std::vector<tin::Vertex> queue_, wave_;  ///< vertices that have yet to pass on their size, and those that are passing
                                           ///< it on
  std::vector<std::uint8_t> states_;  ///< by vertex: kWaits, kFell
};

/// Calls visit(h) for each half-edge out of v, in triangles of the rectangle. `first`: one of them.
template <class Visit>
void visit_around(const tin::Triangulation& tin, tin::HalfEdge first, Visit&& visit) {
  tin::HalfEdge h = first;
  do {
    visit(h);
    h = tin.twin(tin::Triangulation::previous(h));
  } while (h != tin::kNone && h != first);
  if (h != tin::kNone) return;
  for (h = tin.twin(first); h != tin::kNone; h = tin.twin(h)) {
    h = tin::Triangulation::next(h);
    visit(h);
  }
}

}  // namespace scarp::shape
