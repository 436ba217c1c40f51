// Lattice positions of the vertices of a triangulation on the raster.
#pragma once

#include <cstdint>
#include <vector>

namespace scarp::grid {

/// Lattice steps between two samples.
inline constexpr std::int32_t kLatticeSteps = 256;
/// Vertices moved by fitting lie on eighths of a sample: finer positions gain nothing and need more digits.
inline constexpr std::int32_t kFreeStep = kLatticeSteps / 8;

/// Vertices on samples, or on a finer lattice with separate heights.
struct VertexLattice {
  std::int32_t steps = 1;           ///< lattice steps between two samples
  std::vector<float> heights;       ///< by vertex; NaN at nodata; empty if steps is 1: vertices have their samples'
                                    ///< heights
  std::vector<std::uint8_t> fixed;  ///< by vertex: 1 if it must not move or be removed; empty: none is fixed

  bool are_samples() const { return steps == 1; }
};

}  // namespace scarp::grid
