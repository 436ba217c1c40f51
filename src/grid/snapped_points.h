// Scattered points on the integer lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "base/point.h"
#include "grid/point_lattice.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// A point that was snapped to the lattice point of a point at another place. It has an error, but no separate lattice
/// point.
struct Echo {
  std::uint32_t point = 0;   ///< index of its lattice point in SnappedPoints
  std::uint32_t source = 0;  ///< the point of the set
  double z = 0;              ///< its height, or the mean
};

/// The points, each at its own lattice point. Arrays of equal size, in Morton order of the lattice points: points near
/// each other in the plane are near in memory.
struct SnappedPoints {
  PointLattice lattice;
  bool is_exact = false;  ///< the points lie exactly on a decimal lattice
  std::vector<Point> at;
  std::vector<std::uint32_t> source;  ///< the point of the set that represents the lattice point
  std::vector<double> z;              ///< its height, or the mean
  std::uint64_t duplicates = 0;       ///< points dropped because another is at the same place
  std::vector<Echo> echoes;           ///< in the order of their lattice points. EMPTY: for kFinest without lines
  std::vector<std::uint32_t> place;   ///< lattice point of each point in the set, as an index; EMPTY: like `echoes`

  std::size_t size() const { return at.size(); }
};

/// Index of the point at a lattice point, or points.size(). Cost: O(log points).
std::uint32_t find_point(const SnappedPoints& points, Point at);

/// Snaps the points to a lattice and drops duplicates. If the coordinates have few enough decimals, the lattice is the
/// coarsest decimal one that contains them exactly (with kFit, if that has at most 2^24 steps). Otherwise it is the
/// finest one whose step is a power of two. Points then move by up to half a step, at most extent / 2^30 (2^23 with
/// kFloat32 and kFit). Duplicates are points with equal coordinates. In a set with lines, whose vertices are often
/// crowded, different points at one lattice point become echoes. In other sets, kFinest rejects them. Other steps make
/// them echoes, but (except kJudge) reject points nearer than 2^-30 of the extent. With kMean, the first point
/// represents the lattice point. Fails with kInput for a coordinate or height that is not finite or beyond 1e100, an
/// extent below 1e-100, points too near for their extent, no points, and more than 2^31 − 1 points.
Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy,
                                  PointSteps steps = PointSteps::kFinest);
/// The same on a lattice that was found for a set with all these points.
Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy, const FoundLattice& found);

}  // namespace scarp::grid
