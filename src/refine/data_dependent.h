// Algorithm IV: edges that fit the data (Garland & Heckbert 1995, section 4.4; Scape's CheckSwap).
//
// For the quadrilateral of an edge that faces the new vertex, each diagonal is scored by the errors of its two
// triangles. The diagonal with the better score is kept, or, if shapes differ too much, the diagonal with better
// shapes. The fit of a triangle is cached until the triangle is removed, so no triangle is scanned twice. Unlike in
// Scape, every scan covers the closed triangle, so no sample is lost between triangles.
#pragma once

#include <vector>

#include "metric/error_metric.h"
#include "refine/fit_cache.h"
#include "scarp/options.h"
#include "tin/triangulation.h"

namespace scarp::refine {

class DataDependentRule final : public tin::FlipRule {
 public:
  /// The metric must outlive this.
  DataDependentRule(const metric::ErrorMetric& metric, const EdgeRule& rule);

  /// The rule for edges that face a new vertex: by score or by shape.
  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override;
  /// Inserts p under this rule. For EdgeScore::kTight, the edges around p are then flipped by score until no flip
  /// improves it.
  tin::Vertex insert(tin::Triangulation& tin, Point p, tin::Triangulation::Location location);
  /// Triangles that the last insert() changed: around the new vertex, and at flipped edges beyond.
  const std::vector<tin::Triangle>& changed() const { return changed_; }
  /// The fit of a triangle that is not outside.
  const metric::Fit& fit_of(const tin::Triangulation& tin, tin::Triangle t) { return cache_.fit_of(tin, t); }

  std::uint64_t samples_scanned() const { return cache_.samples_scanned(); }
  std::uint64_t triangles_scanned() const { return cache_.triangles_scanned(); }

 private:
  struct Improver;
  bool is_better(const tin::Triangulation& tin, tin::HalfEdge h);
  double combine(double first, double second) const;
  double part(const metric::Fit& fit) const;

  const metric::ErrorMetric& metric_;
  EdgeRule rule_;
  double threshold_;
  FitCache cache_;
  std::vector<tin::Triangle> changed_;
};

}  // namespace scarp::refine
