#include "grid/sample_rows.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "grid/source_failure.h"
#include "grid/window.h"

namespace scarp {

SampleRows::SampleRows(const HeightField& field, std::int32_t most)
    : SampleRows(
          field.cols, field.rows,
          [&field](Point first, std::int32_t cols, std::int32_t rows, float* out) {
            return read_window(field, first.x, first.y, cols, rows, out, cols);
          },
          most) {}

SampleRows::SampleRows(std::int32_t cols, std::int32_t rows, Read read, std::int32_t most)
    : cols_(cols), rows_(rows), read_(std::move(read)) {
  held_.reserve(static_cast<std::size_t>(std::min(most, rows)) * static_cast<std::size_t>(cols));
}

void SampleRows::hold(std::int32_t first, std::int32_t count) {
  const std::ptrdiff_t cols = cols_;
  const std::int32_t from = std::max(first, first_), to = std::min(first + count, first_ + count_);
  const auto read = [&](std::int32_t row, std::int32_t rows) {
    if (rows <= 0) return;
    if (auto done = read_({0, row}, cols_, rows, held_.data() + (row - first) * cols); !done)
      throw SourceFailure{done.error()};
  };
  if (to <= from) {
    held_.resize(static_cast<std::size_t>(count * cols));
    count_ = 0;
    read(first, count);
  } else {
    // Kept rows are moved while there is room for both.
    held_.resize(static_cast<std::size_t>(std::max(count, count_) * cols));
    const auto begin = held_.begin() + (from - first_) * cols, end = held_.begin() + (to - first_) * cols;
    if (first < first_) {
      std::move_backward(begin, end, held_.begin() + (to - first) * cols);
    } else {
      std::move(begin, end, held_.begin() + (from - first) * cols);
    }
    held_.resize(static_cast<std::size_t>(count * cols));
    count_ = 0;
    read(first, from - first);
    read(to, first + count - to);
  }
  first_ = first;
  count_ = count;
}

const float* SampleRows::samples(std::int32_t x, std::int32_t y, std::int32_t count) const {
  if (y >= first_ && y < first_ + count_) return held_.data() + std::ptrdiff_t{y - first_} * cols_ + x;
  apart_.resize(static_cast<std::size_t>(count));
  if (auto read = read_({x, y}, count, 1, apart_.data()); !read) throw SourceFailure{read.error()};
  return apart_.data();
}

}  // namespace scarp
