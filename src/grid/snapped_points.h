// Scattered points on the integer lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "base/point.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// The lattice on which points are distinguished: columns count eastwards, rows southwards, as in a raster.
struct PointLattice {
  double step = 0;  ///< one column and one row, in units of x and y
  std::int32_t cols = 0, rows = 0;
  double west = 0, north = 0;  ///< position of column 0 and row 0
};

/// How fine the lattice is.
enum class PointSteps {
  kFinest,
  kFloat32,  ///< so coarse that float32 holds its points as offsets from the middle; all vertices then lie on it
  kFit,      ///< with room between points for vertices of fitting
  kJudge,    ///< any: points are only judged, so none are too near each other
};

/// A point that shares the lattice point of another, without being at its place: it has no lattice point of its own,
/// but an error.
struct Echo {
  std::uint32_t point = 0;   ///< whose lattice point it is
  std::uint32_t source = 0;  ///< the point of the set
  double z = 0;              ///< its height, or the mean
};

/// The points, each at a lattice point of its own. Arrays of equal size, in Morton order of the lattice points: what is
/// near in the plane is near in memory.
struct SnappedPoints {
  PointLattice lattice;
  bool is_exact = false;  ///< the points lie on the lattice, as decimals
  std::vector<Point> at;
  std::vector<std::uint32_t> source;  ///< the point of the set that stands for the lattice point
  std::vector<double> z;              ///< its height, or the mean
  std::uint64_t duplicates = 0;       ///< points given up for another at their place
  std::vector<Echo> echoes;           ///< in the order of their lattice points. EMPTY: kFinest without lines
  std::vector<std::uint32_t> place;   ///< by point of the set: whose lattice point it shares; EMPTY: as `echoes`

  std::size_t size() const { return at.size(); }
};

/// The point at a place, or points.size(). Cost: O(log points).
std::uint32_t find_point(const SnappedPoints& points, Point at);

/// Snaps the points to a lattice and gives up duplicates. The lattice: the coarsest on which all coordinates lie
/// exactly as decimals, if they have few enough of them; else the finest with a power of two as its step, where points
/// move by up to half a step, at most extent / 2^30 (2^23 with kFloat32, 2^24 with kFit). Duplicates are points with
/// equal coordinates; points that only the lattice cannot distinguish are refused with kFinest, but become echoes with
/// other steps (unless they are nearer than 2^-30 of the extent, except for a judge), and in a set with lines, whose
/// vertices are often crowded. With kMean the first point stands for the
/// lattice point. Fails with kInput: a coordinate or height that is not finite or beyond 1e100, an extent below 1e-100,
/// points too near for their extent, no points, more than 2^31 − 1.
Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy,
                                  PointSteps steps = PointSteps::kFinest);

}  // namespace scarp
