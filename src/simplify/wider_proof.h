// The proof at more points than those of a run.
#pragma once

#include <cstdint>
#include <optional>

#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::run {

/// The bound of a run, and an allowance for rounding; none for a run that ended at a budget.
struct ErrorBound {
  double error = 0, allowance = 0;
};
using RunBound = std::optional<ErrorBound>;

class WiderProof {
 public:
  virtual ~WiderProof() = default;

  /// Number of all points.
  virtual std::uint64_t total() const = 0;
  /// Judges a mesh at all points and sets their statistics. With a bound of the run, adds points that break it, and
  /// their neighbours, to the points of the run. Returns true if there are such points.
  virtual Result<bool> judge(const Mesh& mesh, const RunBound& bound, Measurement& result) = 0;
};

}  // namespace scarp::run
