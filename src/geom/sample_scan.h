// The samples of a closed triangle whose corners lie on a finer lattice.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/point.h"

namespace scarp::geom {

namespace detail {

/// The crossing of a sloping edge with a row of samples, in samples, as exact integers.
struct Crossing {
  std::int64_t floor, ceil;

  /// REQUIRES: a.y < b.y; row·steps is between them.
  Crossing(Point a, Point b, std::int64_t row, std::int32_t steps) {
    const std::int64_t rows = std::int64_t{b.y} - a.y, whole = rows * steps;
    const std::int64_t x = a.x * rows + (row * steps - a.y) * (std::int64_t{b.x} - a.x);  // at least 0, below 2⁶⁰
    floor = x / whole;
    ceil = floor + (x % whole != 0);
  }
};

}  // namespace detail

/// Calls row(y, first, last), from the top down, for every row in which the closed triangle contains samples: first …
/// last. Corners are in units of 1/steps sample. REQUIRES: orient(corners) != 0. Cost: O(rows) plus the calls.
template <class Row>
void scan_samples(std::array<Point, 3> corners, std::int32_t steps, Row&& row) {
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  if (corners[2].y < corners[1].y) std::swap(corners[1], corners[2]);
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  const auto [top, middle, bottom] = corners;
  for (std::int32_t y = (top.y + steps - 1) / steps; y <= bottom.y / steps; ++y) {
    const detail::Crossing along(top, bottom, y, steps);
    const bool is_upper = std::int64_t{y} * steps < middle.y || middle.y == bottom.y;
    const detail::Crossing beside =
        is_upper ? detail::Crossing(top, middle, y, steps) : detail::Crossing(middle, bottom, y, steps);
    const auto first = static_cast<std::int32_t>(std::min(along.ceil, beside.ceil));
    const auto last = static_cast<std::int32_t>(std::max(along.floor, beside.floor));
    if (first <= last) row(y, first, last);
  }
}

}  // namespace scarp::geom
