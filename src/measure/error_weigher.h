// Errors weighted by a mask or by tolerances.
#pragma once

#include <cstdint>
#include <span>

#include "measure/judge.h"

namespace scarp::judge {

/// Sums up rows from the top.
class ErrorWeigher {
 public:
  /// An error counts as above `bound` if error + `reserve` (for the rounding of samples) − `allowance` exceeds `bound`
  /// by more than a factor of 1 + 2^-23. The factor covers the rounding of errors to float32.
  ErrorWeigher(double bound, double reserve, double allowance);

  struct Row {
    std::span<const float> errors;          ///< signed, NaN for nodata or uncovered samples
    std::span<const double> norms = {};     ///< replace `errors` unless empty
    std::span<const float> mask = {};       ///< empty: none
    std::span<const float> tolerance = {};  ///< empty: none
    std::span<const float> limits = {};     ///< a limit above 0: the sample has no bound; empty: none
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
