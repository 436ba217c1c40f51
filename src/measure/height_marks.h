// Random access to the validity of a field's samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/window.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::judge {

/// Reads the field in squares with marks of 4 KB, and caches some hundred squares. So queries along a line read each
/// square once. After a failure of the field's source, no sample is a height, and failure() returns the reason.
class HeightMarks {
 public:
  explicit HeightMarks(const HeightField& field) : field_(field), squares_(kSquares) {}

  /// REQUIRES: the sample lies in the field.
  bool is_height(int col, int row) {
    const std::int64_t x = col / kSide, y = row / kSide;
    Square& square = squares_[static_cast<std::size_t>((x + y * kSquaresAcross) % kSquares)];
    if (square.x != x || square.y != y) read(square, x, y);
    return square.marks[static_cast<std::size_t>(row % kSide * kSide + col % kSide)] != 0;
  }
  /// Success, or the first failure.
  const Result<void>& failure() const { return failure_; }

 private:
  static constexpr int kSide = 64;
  static constexpr std::int64_t kSquares = 512, kSquaresAcross = 37;  // neither is a multiple of the other, so that
                                                                      // columns spread too
  struct Square {
    std::int64_t x = -1, y = -1;
    std::vector<std::uint8_t> marks;
  };

  void read(Square& square, std::int64_t x, std::int64_t y) {
    square.x = x;
    square.y = y;
    square.marks.assign(kSide * kSide, 0);
    const int col = static_cast<int>(x) * kSide, row = static_cast<int>(y) * kSide;
    const int cols = std::min(kSide, field_.cols - col), rows = std::min(kSide, field_.rows - row);
    heights_.resize(kSide * kSide);
    if (!failure_) return;
    failure_ = grid::read_window(field_, col, row, cols, rows, heights_.data(), kSide);
    if (!failure_) return;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        const auto at = static_cast<std::size_t>(r * kSide + c);
        square.marks[at] = std::isnan(heights_[at]) ? 0 : 1;
      }
    }
  }

  const HeightField& field_;
  std::vector<Square> squares_;
  std::vector<float> heights_;
  Result<void> failure_;
};

}  // namespace scarp::judge
