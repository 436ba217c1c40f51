// A height field's rows, one after the other, in memory or from a source.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/window.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

class RowReader {
 public:
  explicit RowReader(const HeightField& field)
      : field_(field),
        most_(std::clamp<int>(kSamplesTogether / field.cols, 1, field.rows)),
        samples_(static_cast<std::size_t>(most_) * static_cast<std::size_t>(field.cols)) {}

  /// The samples of a row, nodata as NaN, the caller's to change, until the next call. Fails as the field's source
  /// does. Rows that are asked for from the top down are read once, some at a time.
  Result<float*> read(int row) {
    if (row < first_ || row >= end_) {
      first_ = row;
      end_ = std::min(row + most_, field_.rows);
      if (auto read = read_window(field_, 0, first_, field_.cols, end_ - first_, samples_.data(), field_.cols); !read)
        return tl::unexpected(read.error());
    }
    return samples_.data() + static_cast<std::ptrdiff_t>(row - first_) * field_.cols;
  }

 private:
  static constexpr int kSamplesTogether = 1 << 18;

  HeightField field_;
  int most_;                 // rows together
  int first_ = 0, end_ = 0;  // that are here
  std::vector<float> samples_;
};

}  // namespace scarp
