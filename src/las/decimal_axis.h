// Coordinates by scale and offset, exactly.
#pragma once

#include <cstdint>

#include "base/int128.h"

namespace scarp::las {

/// i · scale + offset, where scale and offset are the decimals that their doubles are the nearest to: the double
/// nearest to that decimal, so that points keep the lattice of their file. 123456789 · 0.01 is 1234567.89, though no
/// double is 0.01. A scale or an offset of more than 22 decimals, or beyond 10^25, is the double itself.
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
    kSmall,  ///< all numerators are exact in a double
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
