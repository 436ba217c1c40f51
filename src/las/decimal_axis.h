// Exact conversion of integers to coordinates by scale and offset.
#pragma once

#include <cstdint>

#include "base/int128.h"

namespace scarp::las {

/// The double nearest to i · scale + offset, where scale and offset are the short decimals that their doubles
/// represent, so that points stay on the lattice of their file. For example, 123456789 · 0.01 is 1234567.89, though no
/// double equals 0.01. A scale or offset with more than 22 decimals, or beyond 10^25, is used as the double itself.
class DecimalAxis {
 public:
  /// REQUIRES: both are finite.
  DecimalAxis(double scale, double offset);

  double operator()(std::int32_t i) const {
    if (way_ == Way::kSmall) return (static_cast<double>(i) * small_scale_ + small_offset_) / power_;
    return by_large(i);
  }

 private:
  enum class Way {
    kSmall,  ///< doubles represent all numerators exactly
    kLarge,
    kDoubles,
  };

  double by_large(std::int32_t i) const;

  Way way_ = Way::kDoubles;
  double scale_, offset_;
  double small_scale_ = 0, small_offset_ = 0;  ///< times 10^digits
  Int128 large_scale_ = 0, large_offset_ = 0;
  double power_ = 1;  ///< 10^digits
};

}  // namespace scarp::las
