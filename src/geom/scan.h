// The lattice points of a closed triangle, row by row.
//
// Each edge is followed in integers: its crossing with a row is a quotient and a remainder that advance by a fixed step
// (Bresenham's idea with floor and ceiling). Nothing is rounded, so a point on an edge always belongs to both
// triangles, and no row or column is skipped. Rounded spans, as in Scape, lose samples.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "geom/predicates.h"

namespace scarp::geom {

namespace detail {

constexpr std::int32_t kRowsWorthSkipping = 32;  // a division costs as much time as this many rows

/// x of an edge on consecutive rows, as floor(x) and a flag for integer x.
class EdgeWalker {
 public:
  /// REQUIRES: from.y < to.y.
  EdgeWalker(Point from, Point to) : dy_(std::int64_t{to.y} - from.y), x_(from.x) {
    const std::int64_t dx = std::int64_t{to.x} - from.x;
    step_ = dx / dy_;
    step_remainder_ = dx % dy_;
    if (step_remainder_ < 0) {
      --step_;
      step_remainder_ += dy_;
    }
  }
  std::int64_t floor() const { return x_; }
  std::int64_t ceil() const { return x_ + (remainder_ != 0); }
  /// Number of rows until the edge reaches the next integer column on its right or left; more than any raster has if
  /// the edge runs the other way. REQUIRES: the edge is between two columns.
  std::int64_t rows_to_reach(bool is_right) const {
    constexpr std::int64_t kNever = std::int64_t{1} << 40;
    if (is_right) {
      if (step_ != 0) return step_ > 0 ? 1 : kNever;
      return step_remainder_ == 0 ? kNever : (dy_ - remainder_ + step_remainder_ - 1) / step_remainder_;
    }
    if (step_ != -1) return step_ < -1 ? 1 : kNever;
    return (remainder_ + dy_ - step_remainder_ - 1) / (dy_ - step_remainder_);
  }
  void skip_rows(std::int64_t rows) {
    remainder_ += rows * step_remainder_;
    x_ += rows * step_ + remainder_ / dy_;
    remainder_ %= dy_;
  }
  void next_row() {
    x_ += step_;
    remainder_ += step_remainder_;
    if (remainder_ >= dy_) {
      ++x_;
      remainder_ -= dy_;
    }
  }

 private:
  std::int64_t dy_, x_, step_ = 0, step_remainder_ = 0, remainder_ = 0;
};

}  // namespace detail

/// Calls row(y, first, last), in ascending y, for every row in which the closed triangle contains lattice points: first
/// … last (inclusive). REQUIRES: orient(corners) != 0. Cost: O(min(rows, columns + calls)).
template <class Row>
void scan_rows(std::array<Point, 3> corners, Row&& row) {
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  if (corners[2].y < corners[1].y) std::swap(corners[1], corners[2]);
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  const auto [top, middle, bottom] = corners;
  const bool long_edge_is_left = orient(top, bottom, middle) < 0;
  const auto half = [&](detail::EdgeWalker& long_edge, detail::EdgeWalker short_edge, std::int32_t y,
                        std::int32_t end) {
    while (y < end) {
      const detail::EdgeWalker& left = long_edge_is_left ? long_edge : short_edge;
      const detail::EdgeWalker& right = long_edge_is_left ? short_edge : long_edge;
      const std::int64_t first = left.ceil(), last = right.floor();
      if (first <= last) {
        row(y, static_cast<std::int32_t>(first), static_cast<std::int32_t>(last));
      } else if (end - y > detail::kRowsWorthSkipping) {
        // Here both edges are between the same two columns, as in most rows of a sliver.
        const std::int64_t rows =
            std::min({left.rows_to_reach(false), right.rows_to_reach(true), std::int64_t{end} - y});
        long_edge.skip_rows(rows);
        short_edge.skip_rows(rows);
        y += static_cast<std::int32_t>(rows);
        continue;
      }
      long_edge.next_row();
      short_edge.next_row();
      ++y;
    }
  };
  detail::EdgeWalker long_edge(top, bottom);
  if (top.y < middle.y) half(long_edge, detail::EdgeWalker(top, middle), top.y, middle.y);
  if (middle.y < bottom.y) {
    half(long_edge, detail::EdgeWalker(middle, bottom), middle.y, bottom.y + 1);
  } else {
    // A horizontal edge at the bottom: its row runs from corner to corner.
    row(bottom.y, std::min(middle.x, bottom.x), std::max(middle.x, bottom.x));
  }
}

}  // namespace scarp::geom
