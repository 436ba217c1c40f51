// The proof at more points than those of a run.
#pragma once

#include <cstdint>

#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::run {

class WiderProof {
 public:
  virtual ~WiderProof() = default;

  /// Number of all points.
  virtual std::uint64_t total() const = 0;
  /// Judges a mesh at all points and sets their statistics. Adds points with errors above the bound, and their
  /// neighbours, to the points of the run. Returns true if there are such points.
  virtual Result<bool> judge(const Mesh& mesh, double bound, Measurement& result) = 0;
  /// Fails with kMemory if a mesh with so many vertices does not fit.
  virtual Result<void> check_memory(std::uint64_t vertices) const = 0;
};

}  // namespace scarp::run
