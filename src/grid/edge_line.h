// Simplifies an edge whose samples have several values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/options.h"

namespace scarp::grid {

/// The values of one field along an edge. NaN is nodata, but only in the first field.
struct EdgeField {
  std::span<const float> values;
  double scale = 1;  ///< weight of its errors, at least 0
};

/// Like simplify_edge(), for the norm of the fields' errors. With several fields, a segment spans at most 256 steps,
/// and the cost is at worst O(samples · 256²).
std::vector<std::int32_t> simplify_edge(std::span<const EdgeField> fields, Norm norm, double tolerance,
                                        std::span<const double> tolerances);

/// The value at sample i on the chord from sample a to sample b.
inline double chord_value(std::span<const float> values, std::int32_t a, std::int32_t b, std::int32_t i) {
  const double from = values[static_cast<std::size_t>(a)], to = values[static_cast<std::size_t>(b)];
  return from + (to - from) * (static_cast<double>(i - a) / (b - a));
}
/// The norm of a chord's errors at sample i. The chord connects samples a and b.
double chord_error(std::span<const EdgeField> fields, Norm norm, std::int32_t a, std::int32_t b, std::int32_t i);

}  // namespace scarp::grid
