// Bounds of samples for laws, in memory and in windows.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::testing {

inline constexpr float kNoBound = std::numeric_limits<float>::infinity();

/// Reads windows of an array without changes: infinities remain.
class ArrayBounds : public SampleSource {
 public:
  ArrayBounds(std::span<const float> bounds, int cols) : bounds_(bounds), cols_(cols) {}
  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    for (int y = 0; y < rows; ++y) {
      const auto first = static_cast<std::size_t>(row + y) * static_cast<std::size_t>(cols_);
      const auto from = bounds_.subspan(first + static_cast<std::size_t>(col), static_cast<std::size_t>(cols));
      std::copy(from.begin(), from.end(), out + y * stride);
    }
    return {};
  }
  bool is_in_memory() const override { return false; }

 private:
  std::span<const float> bounds_;
  int cols_;
};

/// Blocks with one bound each, and scattered samples in them.
inline std::vector<float> any_bounds(int cols, int rows) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const int side = *rc::gen::element(1, 4, 9, 100);
  const auto base = *rc::gen::element(0.02f, 0.5f, 2.0f, 7.3f);
  const float levels[] = {base, base, 1000 * base, base / 1000, 30 * base, kNoBound, 0};
  std::vector<float> blocks(10000), bounds;
  for (float& bound : blocks) bound = levels[random() % 7];
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x) {
      const auto block = static_cast<std::size_t>(y / side * 83 + x / side) % blocks.size();
      bounds.push_back(random() % 16 == 0 ? levels[random() % 7] : blocks[block]);
    }
  }
  return bounds;
}

}  // namespace scarp::testing
