// How long edges may be at each vertex when sizes are to grow slowly (Persson 2006, "Mesh size functions for implicit
// geometries and PDE-based gradient limiting"; here on the graph of the mesh itself).
#pragma once

#include <vector>

#include "shape/plan_metric.h"
#include "tin/triangulation.h"

namespace scarp {

/// The size at a vertex is the least s + grade·d over all vertices, where s is the length of the shortest edge at one
/// and d the way from there, along edges. Sizes only fall while a mesh grows: an edge that is flipped away has been
/// considered all the same.
class SizeField {
 public:
  /// Both stay alive. Lengths below `least` count as that.
  SizeField(const Triangulation& tin, const PlanMetric& metric, double grade, double least)
      : tin_(tin), metric_(metric), grade_(grade), least_(least) {}

  /// Measures the sizes of all vertices. `out`: for each one a half-edge that begins there.
  void measure_all(const std::vector<HalfEdge>& out);
  /// After an insertion; `changed`: the triangles around the new vertex. Appends the vertices whose sizes fell, each
  /// once.
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
  std::vector<Vertex> queue_, wave_;  ///< vertices whose neighbours have not got its size yet, and those that are
                                      ///< passing it on
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
