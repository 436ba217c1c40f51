// Statistics of errors that do not depend on who counted what first.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace scarp::judge {

/// Counts |error| in buckets of equal leading bits: 2^12 to a power of two, so a bucket's ends differ by at most 0.025
/// %. Pages of counts are made when first needed.
class Histogram {
 public:
  void add(float magnitude);
  void merge(const Histogram& other);
  /// Upper end of the bucket in which the `permille`·n/1000-th smallest value lies; 0 if nothing was counted.
  double percentile(unsigned permille) const;

 private:
  static constexpr unsigned kShift = 11, kPageBits = 12;
  using Page = std::array<std::uint64_t, 1u << kPageBits>;
  std::array<std::unique_ptr<Page>, 256> pages_;  // by the exponent of the float
  std::uint64_t count_ = 0;
};

/// A running sum with Neumaier's compensation.
class Sum {
 public:
  void add(double value);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// Sums of one row, in column order.
struct RowSums {
  std::uint64_t samples = 0;
  double error = 0, magnitude = 0, square = 0;
  double largest = -1;  ///< |error|; −1 if there is no sample
  int largest_at = -1;  ///< its lowest column
};

/// Sums up the errors that are not NaN and counts them in `histogram`.
RowSums sum_row(std::span<const double> errors, Histogram& histogram);

}  // namespace scarp::judge
