// Lattice positions of the vertices of a triangulation on the raster.
#pragma once

#include <cstdint>
#include <vector>

namespace scarp {

/// Steps of the lattice between two samples.
inline constexpr std::int32_t kLatticeSteps = 256;
/// Vertices that fitting sets free stand on eighths of a sample: finer points are worth nothing, and have more digits.
inline constexpr std::int32_t kFreeStep = kLatticeSteps / 8;

/// On samples, or on a finer lattice with heights of their own.
struct VertexLattice {
  std::int32_t steps = 1;           ///< number of steps of the triangulation's points between two samples
  std::vector<float> heights;       ///< by vertex; NaN at nodata; empty where steps is 1: a vertex has its sample's
  std::vector<std::uint8_t> fixed;  ///< by vertex: 1 if it must stay where it is; empty: all may go

  bool are_samples() const { return steps == 1; }
};

}  // namespace scarp
