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

/// The resolution of the lattice.
enum class PointSteps {
  kFinest,
  kFloat32,  ///< so coarse that offsets of its points from the middle are exact float32; all vertices then lie on it
  kFit,      ///< leaves space between points for vertices moved by fitting
  kJudge,    ///< any resolution: points are only judged, so none are too near each other
};

/// A point that shares another's lattice point at a different place. It has an error, but no own lattice point.
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
  std::vector<std::uint32_t> source;  ///< the point of the set that stands for the lattice point
  std::vector<double> z;              ///< its height, or the mean
  std::uint64_t duplicates = 0;       ///< points dropped for another at the same place
  std::vector<Echo> echoes;           ///< in the order of their lattice points. EMPTY: kFinest without lines
  std::vector<std::uint32_t> place;   ///< by point of the set: index of its lattice point; EMPTY: as `echoes`

  std::size_t size() const { return at.size(); }
};

/// Index of the point at a lattice point, or points.size(). Cost: O(log points).
std::uint32_t find_point(const SnappedPoints& points, Point at);

/// Snaps the points to a lattice and drops duplicates. If the coordinates have few enough decimals, the lattice is the
/// coarsest decimal one that contains them exactly. Otherwise it is the finest whose step is a power of two; points
/// then move by up to half a step, at most extent / 2^30 (2^23 with kFloat32, 2^24 with kFit). Duplicates are points
/// with equal coordinates. In a set with lines, whose vertices are often crowded, different points at one lattice point
/// become echoes. In other sets kFinest rejects them; other steps make them echoes, unless they are nearer than 2^-30
/// of the extent (no limit with kJudge). With kMean the first point stands for the lattice point. Fails with kInput: a
/// coordinate or height that is not finite or beyond 1e100, an extent below 1e-100, points too near for their extent,
/// no points, more than 2^31 − 1.
Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy,
                                  PointSteps steps = PointSteps::kFinest);

}  // namespace scarp
