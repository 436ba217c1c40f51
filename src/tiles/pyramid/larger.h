#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::tiles {

/// The larger error; NaN (unknown) if either is NaN.
template <class T>
T larger(T a, T b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<T>::quiet_NaN() : std::max(a, b);
}

}  // namespace scarp::tiles
