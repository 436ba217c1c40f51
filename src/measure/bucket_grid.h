// Equal buckets over the plane, each with the ids of the shapes that touch it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "measure/plan_triangle.h"

namespace scarp::judge {

struct Box {
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  void include(double x, double y) {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
  }
};

class BucketGrid {
 public:
  /// Buckets over `box`, about `buckets` in number and nearly square. The outermost buckets extend to infinity: points
  /// and shapes outside `box` belong to the nearest bucket.
  BucketGrid(const Box& box, std::size_t buckets) : box_(box) {
    const double width = std::max(box.x1 - box.x0, 0.0), height = std::max(box.y1 - box.y0, 0.0);
    const double count = static_cast<double>(std::clamp<std::size_t>(buckets, 1, std::size_t{1} << 28));
    const double longest = std::max(width, height), shortest = std::max(std::min(width, height), longest / count);
    const double along = std::clamp(std::sqrt(count * (longest > 0 ? longest / shortest : 1)), 1.0, count);
    const int major = static_cast<int>(along), minor = std::max(1, static_cast<int>(count / along));
    cols_ = width >= height ? major : minor;
    rows_ = width >= height ? minor : major;
    step_x_ = width > 0 ? width / cols_ : 1;
    step_y_ = height > 0 ? height / rows_ : 1;
  }

  int cols() const { return cols_; }
  int rows() const { return rows_; }
  int col_of(double x) const { return whole((x - box_.x0) / step_x_, cols_ - 1); }
  int row_of(double y) const { return whole((y - box_.y0) / step_y_, rows_ - 1); }
  std::span<const std::uint32_t> bucket(int col, int row) const {
    const std::size_t b = index(col, row);
    return {entries_.data() + starts_[b], starts_[b + 1] - starts_[b]};
  }
  Box bucket_box(int col, int row) const {
    const double x = box_.x0 + col * step_x_, y = box_.y0 + row * step_y_;
    return {x, y, x + step_x_, y + step_y_};
  }

  /// Fills the buckets. each(visit) calls visit(id, shape) for every shape, in the same order each time; a shape has
  /// y_extent() and x_range(lo, hi). The entries of a bucket have that order.
  template <class Each>
  void fill(const Each& each) {
    starts_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_) + 1, 0);
    each([&](std::uint32_t, const auto& shape) { touch(shape, [&](std::size_t b) { ++starts_[b + 1]; }); });
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    entries_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    each([&](std::uint32_t id, const auto& shape) { touch(shape, [&](std::size_t b) { entries_[next[b]++] = id; }); });
  }

 private:
  static int whole(double value, int most) { return value > 0 ? static_cast<int>(std::min<double>(value, most)) : 0; }
  std::size_t index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
  }
  template <class Shape, class Visit>
  void touch(const Shape& shape, const Visit& visit) const {
    const Interval along = shape.y_extent();
    // Slightly more than the bucket, so that rounding cannot lose shapes on its border.
    const double hair_x = 1e-9 * step_x_ + 1e-15 * std::max(std::abs(box_.x0), std::abs(box_.x1));
    const double hair_y = 1e-9 * step_y_ + 1e-15 * std::max(std::abs(box_.y0), std::abs(box_.y1));
    const int first = row_of(along.lo - hair_y), last = row_of(along.hi + hair_y);
    for (int row = first; row <= last; ++row) {
      const double y = box_.y0 + row * step_y_;
      const Interval across =
          shape.x_range(row == 0 ? -HUGE_VAL : y - hair_y, row == rows_ - 1 ? HUGE_VAL : y + step_y_ + hair_y);
      const int begin = col_of(across.lo - hair_x), end = col_of(across.hi + hair_x);
      for (int col = begin; col <= end; ++col) visit(index(col, row));
    }
  }

  Box box_;
  int cols_ = 1, rows_ = 1;
  double step_x_ = 1, step_y_ = 1;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> entries_;
};

}  // namespace scarp::judge
