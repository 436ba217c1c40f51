// Algorithm IV: edges that fit the data (Garland & Heckbert 1995, section 4.4; Scape's CheckSwap).
//
// For the quadrilateral of an edge that faces the new vertex both diagonals are scored by the errors of the triangles
// they make, and the better one is kept; where the shapes differ too much, the better shaped one. Facts about a
// triangle are kept until the triangle is gone, so that nothing is scanned twice. Unlike Scape's, every scan covers the
// closed triangle, so no sample gets lost between two of them.
#pragma once

#include <vector>

#include "metric/error_metric.h"
#include "refine/fit_cache.h"
#include "scarp/options.h"
#include "tin/triangulation.h"

namespace scarp {

class DataDependentRule final : public FlipRule {
 public:
  /// The metric stays alive.
  DataDependentRule(const ErrorMetric& metric, const EdgeRule& rule);

  /// The rule for edges that face a new vertex: the score decides, or the shape.
  bool should_flip(const Triangulation& tin, HalfEdge h) override;
  /// Inserts p under this rule; for EdgeScore::kTight the edges around it are then tried by score until none improves.
  Vertex insert(Triangulation& tin, Point p, Triangulation::Location location);
  /// Triangles that the last insert() changed: those around the new vertex, and where edges beyond them were flipped.
  const std::vector<Triangle>& changed() const { return changed_; }
  /// The fit of a triangle that is not outside.
  const Fit& fit_of(const Triangulation& tin, Triangle t) { return cache_.fit_of(tin, t); }

  std::uint64_t samples_scanned() const { return cache_.samples_scanned(); }
  std::uint64_t triangles_scanned() const { return cache_.triangles_scanned(); }

 private:
  struct Improver;
  bool is_better(const Triangulation& tin, HalfEdge h);
  double combine(double first, double second) const;
  double part(const Fit& fit) const;

  const ErrorMetric& metric_;
  EdgeRule rule_;
  double threshold_;
  FitCache cache_;
  std::vector<Triangle> changed_;
};

}  // namespace scarp
