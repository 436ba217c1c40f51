// Algorithm IV: edges that fit the data (Garland & Heckbert 1995, section 4.4; Scape's CheckSwap).
//
// For the quadrilateral of an edge that faces the new vertex both diagonals are scored by the errors of the triangles
// they make, and the better one is kept; where the shapes differ too much, the better shaped one. What was found out
// about a triangle is kept until the triangle is gone, so that nothing is scanned twice. Unlike Scape's, every
// scan covers the closed triangle, so no sample gets lost between two of them.
#pragma once

#include <vector>

#include "refine/judge.h"
#include "scarp/strategy.h"
#include "tin/triangulation.h"

namespace scarp {

class DataDependentRule final : public FlipRule {
 public:
  /// The judge stays alive.
  DataDependentRule(const Judge& judge, const EdgeRule& rule);

  bool should_flip(const Triangulation& tin, HalfEdge h) override;
  /// The fit of a triangle that is not outside: remembered, or looked at now.
  const Fit& fit_of(const Triangulation& tin, Triangle t);

  std::uint64_t samples_scanned() const { return samples_; }
  std::uint64_t triangles_scanned() const { return triangles_; }

 private:
  struct Known {
    std::array<Vertex, 3> corners{kNone, kNone, kNone};  // ascending
    Fit fit;
  };
  Fit look(const std::array<Point, 3>& corners, double give_up);
  void remember(Triangle t, std::array<Vertex, 3> corners, const Fit& fit);
  double part(const Fit& fit) const;

  const Judge& judge_;
  EdgeRule rule_;
  double threshold_;
  std::vector<Known> known_;
  std::uint64_t samples_ = 0, triangles_ = 0;
};

}  // namespace scarp
