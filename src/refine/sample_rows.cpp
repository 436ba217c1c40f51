#include "refine/sample_rows.h"

#include <algorithm>
#include <cstddef>

#include "grid/window.h"
#include "refine/source_judge.h"

namespace scarp {

SampleRows::SampleRows(const HeightField& field, std::int32_t most) : field_(field) {
  held_.reserve(static_cast<std::size_t>(std::min(most, field.rows)) * static_cast<std::size_t>(field.cols));
}

void SampleRows::hold(std::int32_t first, std::int32_t count) {
  const std::ptrdiff_t cols = field_.cols;
  const std::int32_t from = std::max(first, first_), to = std::min(first + count, first_ + count_);
  const auto read = [&](std::int32_t row, std::int32_t rows) {
    if (rows <= 0) return;
    if (auto done = read_window(field_, 0, row, field_.cols, rows, held_.data() + (row - first) * cols, cols); !done)
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
  if (y >= first_ && y < first_ + count_) return held_.data() + std::ptrdiff_t{y - first_} * field_.cols + x;
  apart_.resize(static_cast<std::size_t>(count));
  if (auto read = read_window(field_, x, y, count, 1, apart_.data(), count); !read) throw SourceFailure{read.error()};
  return apart_.data();
}

}  // namespace scarp
