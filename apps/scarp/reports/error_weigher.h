// What errors weigh: under a mask, by tolerances.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace scarp::cli {

/// The largest of some errors, without sign, and its sample (col, row): none, (−1, −1), if all are 0.
struct LargestError {
  double value = 0;
  std::array<std::int32_t, 2> at{-1, -1};
};

/// What a bound is compared with: heights' errors or norms, under a mask or tolerances.
struct WeighedErrors {
  LargestError largest;    ///< of all judged samples, without their rounding
  LargestError bounded;    ///< of those with a bound
  double rmse = 0;         ///< over all judged samples
  std::uint64_t over = 0;  ///< samples above `bound`, their rounding counted; not those without a bound
};

/// weight · error, or error / tolerance (0 / 0 is 0).
double weigh_by_mask(float weight, double error);
double weigh_by_tolerance(float tolerance, double error);

/// Sums up row after row, from the top.
class ErrorWeigher {
 public:
  /// A sample is above `bound` by more than the `allowance`, which is taken off errors after the `reserve` for the
  /// rounding of samples is added, and 2^-23 of the bound, since the judge hands out errors as float32.
  ErrorWeigher(double bound, double reserve, double allowance);

  struct Row {
    std::span<const float> errors;          ///< signed, NaN where void or uncovered
    std::span<const double> norms = {};     ///< these count in their place, unless it is empty
    std::span<const float> mask = {};       ///< empty: none
    std::span<const float> tolerance = {};  ///< empty: none
    std::span<const float> limits = {};     ///< as Exceptions::limits; empty: none
  };
  void add(int row, const Row& values);
  WeighedErrors finish() const;

 private:
  double limit_, reserve_, allowance_;
  WeighedErrors weighed_;
  double sum_of_squares_ = 0;
  std::uint64_t judged_ = 0;
};

}  // namespace scarp::cli
