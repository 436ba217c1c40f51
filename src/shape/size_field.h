// Sizes, the longest edges allowed at each vertex, that grow slowly (Persson 2006, "Mesh size functions for implicit
// geometries and PDE-based gradient limiting"; here on the graph of the mesh itself).
#pragma once

#include <vector>

#include "shape/plan_metric.h"
#include "tin/triangulation.h"

namespace scarp {

/// The size at a vertex is the least s + grade·d over all vertices, where s is the length of such a vertex's shortest
/// edge and d is its distance along edges. Sizes only fall while a mesh grows: edges that were flipped away also count.
class SizeField {
 public:
  /// Borrows `tin` and `metric`. Lengths below `least` count as `least`.
  SizeField(const Triangulation& tin, const PlanMetric& metric, double grade, double least)
      : tin_(tin), metric_(metric), grade_(grade), least_(least) {}

  /// Measures the sizes of all vertices. `out`: a half-edge out of each one.
  void measure_all(const std::vector<HalfEdge>& out);
  /// Updates sizes after an insertion; `changed`: the triangles around the new vertex. Appends each vertex whose size
  /// fell to `fallen`, once.
  void update(const std::vector<Triangle>& changed, const std::vector<HalfEdge>& out, std::vector<Vertex>& fallen);

  double at(Vertex v) const { return sizes_[v]; }

 private:
  static constexpr std::uint8_t kWaits = 1, kFell = 2;

  void take_lengths(Triangle t);
  void lower(Vertex v, double size);
  void spread(const std::vector<HalfEdge>& out, std::vector<Vertex>* fallen);
  double length(Vertex v, Vertex w) const;

  const Triangulation& tin_;
  const PlanMetric& metric_;
  double grade_, least_;
  std::vector<double> sizes_;
  std::vector<Vertex> queue_, wave_;  ///< vertices that have yet to pass on their size, and those that are passing it
                                      ///< on
  std::vector<std::uint8_t> states_;  ///< by vertex: kWaits, kFell
};

/// Calls visit(h) for each half-edge out of v, in triangles of the rectangle. `first`: one of them.
template <class Visit>
void visit_around(const Triangulation& tin, HalfEdge first, Visit&& visit) {
  HalfEdge h = first;
  do {
    visit(h);
    h = tin.twin(Triangulation::previous(h));
  } while (h != kNone && h != first);
  if (h != kNone) return;
  for (h = tin.twin(first); h != kNone; h = tin.twin(h)) {
    h = Triangulation::next(h);
    visit(h);
  }
}

}  // namespace scarp
