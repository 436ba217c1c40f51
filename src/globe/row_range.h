// The points of a straight row that lie inside a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scarp/tile.h"

namespace scarp::globe {

/// Begin and end of the points in the box, among `count` points at equal steps. Because of rounding, points that are
/// outside by less than 1/100,000,000 of the box count as inside.
inline std::pair<std::size_t, std::size_t> range_within(double x, double step_x, double y, double step_y,
                                                        std::size_t count, const DegreeBox& box) {
  double first = 0, last = static_cast<double>(count) - 1;
  const auto limit = [&](double start, double step, double low, double high) {
    const double margin = 1e-8 * (high - low);
    low = (low - margin) - start;
    high = (high + margin) - start;
    if (step == 0) {
      if (low > 0 || high < 0) last = -1;
      return;
    }
    if (step < 0) std::swap(low, high);
    first = std::max(first, std::ceil(low / step));
    last = std::min(last, std::floor(high / step));
  };
  limit(x, step_x, box.west, box.east);
  limit(y, step_y, box.south, box.north);
  if (!(first <= last)) return {0, 0};
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last) + 1};
}

}  // namespace scarp::globe
