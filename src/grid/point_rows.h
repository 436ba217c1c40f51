// A few samples of a raster, by rows.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/point.h"
#include "base/sort.h"
#include "scarp/height_field.h"

namespace scarp::grid {

class PointRows {
 public:
  PointRows() = default;
  explicit PointRows(std::span<const SampleAt> samples) {
    for (const SampleAt& at : samples) points_.push_back({at.col, at.row});
    sort_rarely(points_, before);
  }

  bool empty() const { return points_.empty(); }
  /// Calls visit(x) for the samples of a row in columns [first, first + cols).
  template <class Visit>
  void visit(std::int32_t row, std::int32_t first, std::int32_t cols, Visit&& visit) const {
    auto at = std::lower_bound(points_.begin(), points_.end(), Point{first, row}, before);
    for (; at != points_.end() && at->y == row && at->x < first + cols; ++at) visit(at->x);
  }

 private:
  std::vector<Point> points_;
};

}  // namespace scarp::grid
