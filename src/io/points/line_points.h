// Builds the lines of a set of points while a file is read.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "scarp/height_field.h"

namespace scarp::io {

/// Builds a line of points as they are added to a set, without repetitions. A ring ends with its first point.
class LinePoints {
 public:
  explicit LinePoints(PointSet& points) : points_(points), first_(static_cast<std::uint32_t>(points.size())) {}

  /// Appends the set's last point to the line. Removes it from the set if it repeats the line's last or first point.
  void add_last() {
    const auto here = static_cast<std::uint32_t>(points_.size() - 1);
    const bool is_repeated = !line_.points.empty() && is_same(here, line_.points.back()),
               is_closed = !is_repeated && here > first_ && is_same(here, first_);
    if (is_repeated || is_closed) {
      points_.x.pop_back();
      points_.y.pop_back();
      points_.z.pop_back();
    }
    if (!is_repeated) line_.points.push_back(is_closed ? first_ : here);
  }

  /// Adds the line to the set; returns false without adding if it has fewer than two points.
  bool finish(std::string name, bool keeps_vertices = false) {
    if (line_.points.size() < 2) return false;
    line_.name = std::move(name);
    line_.keeps_vertices = keeps_vertices;
    points_.lines.push_back(std::move(line_));
    return true;
  }

 private:
  bool is_same(std::uint32_t a, std::uint32_t b) const {
    return points_.x[a] == points_.x[b] && points_.y[a] == points_.y[b] && points_.z[a] == points_.z[b];
  }

  PointSet& points_;
  std::uint32_t first_;
  PointLine line_;
};

}  // namespace scarp::io
