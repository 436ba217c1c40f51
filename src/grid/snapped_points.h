// Scattered points on the integer lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "base/point.h"
#include "scarp/points.h"
#include "scarp/result.h"

namespace scarp {

/// The lattice on which points are told apart: columns count eastwards, rows southwards, as in a raster.
struct PointLattice {
  double step = 0;  ///< one column and one row, in units of x and y
  std::int32_t cols = 0, rows = 0;
};

/// The points, each at a lattice point of its own. Arrays of equal size, in Morton order of the lattice points: what is
/// near in the plane is near in memory.
struct SnappedPoints {
  PointLattice lattice;
  bool is_exact = false;  ///< the points lie on the lattice, as decimals
  std::vector<Point> at;
  std::vector<std::uint32_t> source;  ///< the point of the set that stands for the lattice point
  std::vector<double> z;              ///< its height, or the mean
  std::uint64_t duplicates = 0;       ///< points that no lattice point stands for

  std::size_t size() const { return at.size(); }
};

/// Snaps the points to a lattice and gives up duplicates. The lattice: the coarsest on which all coordinates lie
/// exactly as decimals, if they have few enough of them; else the finest with a power of two as its step, where points
/// move by up to half a step, at most extent / 2^30. Duplicates are points with equal coordinates; points that only the
/// lattice cannot tell apart are refused. With kMean the first point stands for the lattice point. Fails with kInput: a
/// coordinate or height that is not finite or beyond 1e100, an extent below 1e-100, points too near for their extent,
/// no points, more than 2^31 − 1.
Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy);

}  // namespace scarp
