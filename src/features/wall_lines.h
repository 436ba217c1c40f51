// Two lines with few vertices for a wall: one along its top, one along its foot.
#pragma once

#include <cstdint>
#include <vector>

#include "features/crack_chains.h"
#include "grid/vertex_lattice.h"

namespace scarp::features {

/// A vertex of a line, in units of 1 / kLatticeSteps of a sample.
struct WallVertex {
  Point at;
  float height;
  friend bool operator==(const WallVertex&, const WallVertex&) = default;
};

/// Part of a wall: two polylines without a common point, with the same number of vertices, at least two. A ring ends
/// with its first vertex.
struct Wall {
  std::vector<WallVertex> top, foot;
};

/// The parts of a chain in which lines are worth their vertices, each part with the fewest vertices.
///
/// Along each part, the high samples of its cracks lie on the left of `top`, the low samples on the right of `foot`,
/// and no samples between these lines. Vertices lie on cracks. Memory: kWallBytesPerCrack.
std::vector<Wall> find_walls(const CrackChain& chain, double tolerance);

inline constexpr std::uint64_t kWallBytesPerCrack = 1000;

}  // namespace scarp::features
