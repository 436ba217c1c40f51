// Two lines for a wall: one along its top, one along its foot, with few vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "features/crack_chains.h"
#include "grid/vertex_places.h"

namespace scarp {

/// A vertex of a line, in kLatticeSteps of a sample.
struct FaultVertex {
  Point at;
  float height;
  friend bool operator==(const FaultVertex&, const FaultVertex&) = default;
};

/// Part of a wall: two polylines of equally many vertices, at least two, that have no point in common. A ring ends with
/// its first vertex.
struct Fault {
  std::vector<FaultVertex> top, foot;
};

/// The parts of a chain for which lines are worth their vertices, and the lines with the fewest vertices for them.
///
/// Along each part the high samples of its cracks lie on the left of `top`, the low ones on the right of `foot`, none
/// between; vertices lie on cracks. Memory: kFaultBytesPerCrack.
std::vector<Fault> find_faults(const CrackChain& chain, double tolerance);

inline constexpr std::uint64_t kFaultBytesPerCrack = 1000;

}  // namespace scarp
