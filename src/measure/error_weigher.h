// Weighted errors: under a mask, by tolerances.
#pragma once

#include <cstdint>
#include <span>

#include "measure/judge.h"

namespace scarp::judge {

/// Sums up rows from the top.
class ErrorWeigher {
 public:
  /// An error plus the `reserve` (for the rounding of samples) minus the `allowance` counts as above `bound` if it
  /// exceeds it by more than 2^-23 of it, since the judge returns errors as float32.
  ErrorWeigher(double bound, double reserve, double allowance);

  struct Row {
    std::span<const float> errors;          ///< signed, NaN where nodata or uncovered
    std::span<const double> norms = {};     ///< replace `errors` unless empty
    std::span<const float> mask = {};       ///< empty: none
    std::span<const float> tolerance = {};  ///< empty: none
    std::span<const float> limits = {};     ///< above 0: no bound; empty: none
  };
  void add(int row, const Row& values);
  WeighedErrors finish() const;

 private:
  double limit_, reserve_, allowance_;
  WeighedErrors weighed_;
  double sum_of_squares_ = 0;
  std::uint64_t judged_ = 0;
};

}  // namespace scarp::judge
