// Weighted errors: under a mask, by tolerances.
#pragma once

#include <cstdint>
#include <span>

#include "measure/judge.h"

namespace scarp::judge {

/// Sums up row after row, from the top.
class ErrorWeigher {
 public:
  /// A sample is above `bound` by more than the `allowance`, which is subtracted from errors after the `reserve` for
  /// the rounding of samples is added, and 2^-23 of the bound, since the judge hands out errors as float32.
  ErrorWeigher(double bound, double reserve, double allowance);

  struct Row {
    std::span<const float> errors;          ///< signed, NaN where nodata or uncovered
    std::span<const double> norms = {};     ///< these count in their place, unless it is empty
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
