// Scattered points as the surface whose shapes are refined.
#pragma once

#include <span>

#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "shape/shape_bench.h"

namespace scarp::shape {

/// New vertices between points have the height of the surface there, as float32, so that the bound needs few other
/// vertices.
class PointBench final : public ShapeBench {
 public:
  /// The arguments are those of ScatteredRefinement.
  PointBench(const grid::SnappedPoints& points, std::span<const double> heights, refine::ScatteredDomain& domain,
             double threshold, std::span<const double> bounds)
      : points_(points), heights_(heights), domain_(domain), refinement_(points, heights, domain, threshold, bounds) {}

  bool done() const override { return refinement_.done(); }
  bool is_full() const override { return refinement_.is_full(); }
  double worst_error() const override { return refinement_.worst_error(); }
  void insert_worst() override { refinement_.insert_worst(); }
  bool insert(Point p, const tin::Triangulation::Location& location) override;
  void insert_on_edge(Point p, tin::HalfEdge h, double share) override;
  const std::vector<tin::Triangle>& changed() const override { return refinement_.changed(); }
  std::uint64_t samples_scanned() const override { return refinement_.points_scanned(); }
  std::uint64_t triangles_scanned() const override { return refinement_.lists_dealt(); }

 private:
  void insert_at(Point p, double z, const tin::Triangulation::Location& location);

  const grid::SnappedPoints& points_;
  std::span<const double> heights_;
  refine::ScatteredDomain& domain_;
  refine::ScatteredRefinement refinement_;
};

}  // namespace scarp::shape
