// Scattered points as the surface whose shapes are refined.
#pragma once

#include <span>

#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "shape/shape_bench.h"

namespace scarp {

/// New vertices between points have the height of the surface there, as float32, so that the bound needs few other
/// vertices.
class PointBench final : public ShapeBench {
 public:
  /// The arguments are those of ScatteredRefinement.
  PointBench(const SnappedPoints& points, std::span<const double> heights, ScatteredDomain& domain, double threshold,
             std::span<const double> bounds)
      : points_(points), heights_(heights), domain_(domain), refinement_(points, heights, domain, threshold, bounds) {}

  bool done() const override { return refinement_.done(); }
  bool is_full() const override { return refinement_.is_full(); }
  double worst_error() const override { return refinement_.worst_error(); }
  void insert_worst() override { refinement_.insert_worst(); }
  bool insert(Point p, const Triangulation::Location& location) override;
  void insert_on_edge(Point p, HalfEdge h, double share) override;
  const std::vector<Triangle>& changed() const override { return refinement_.changed(); }
  std::uint64_t samples_scanned() const override { return refinement_.points_scanned(); }
  std::uint64_t triangles_scanned() const override { return refinement_.lists_dealt(); }

 private:
  void insert_at(Point p, double z, const Triangulation::Location& location);

  const SnappedPoints& points_;
  std::span<const double> heights_;
  ScatteredDomain& domain_;
  ScatteredRefinement refinement_;
};

}  // namespace scarp
