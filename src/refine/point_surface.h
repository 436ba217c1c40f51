// The surface through all points of a set: the Delaunay triangulation of their convex hull.
#pragma once

#include <array>

#include "refine/scattered.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::refine {

class PointSurface {
 public:
  /// Fails if snap_points() or build_domain() fails. Cost: expected O(n log n).
  static Result<PointSurface> make(const PointSet& points, DuplicatePolicy duplicates);

  struct Height {
    double z = 0;
    double distance = 0;  ///< from the hull to a place outside it, in units of x and y; z is then that of the nearest
                          ///< place on the hull
  };
  Height at(double x, double y) const;
  /// The mean distance between neighbouring points, in units of x and y.
  double spacing() const;

 private:
  PointSurface(grid::SnappedPoints snapped, ScatteredDomain domain)
      : snapped_(std::move(snapped)), domain_(std::move(domain)) {}
  Height beyond(double x, double y) const;

  grid::SnappedPoints snapped_;
  ScatteredDomain domain_;
  mutable tin::Triangle hint_ = 0;
};

}  // namespace scarp::refine
