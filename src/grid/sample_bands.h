// Rows of a raster in bands, for passes over a mesh from the top down that look only a little beyond a band.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "grid/sample_rows.h"

namespace scarp {

/// Bands of which each is at work once in a sweep, with half as much of its neighbours on both sides in memory.
struct SampleBands {
  std::int32_t rows = 0, side = 1;

  std::size_t count() const { return static_cast<std::size_t>((rows - 1) / side + 1); }
  std::int32_t begin(std::size_t i) const { return static_cast<std::int32_t>(i) * side; }
  std::size_t at(std::int32_t row) const { return static_cast<std::size_t>(row / side); }
  /// A little above a band counts as in it, so that it need not wait for another sweep.
  bool reaches(std::size_t i, std::int32_t row) const { return row >= begin(i) - side / 4 && row < begin(i) + side; }
  void hold(std::size_t i, SampleRows& samples) const {
    const std::int32_t first = std::max(begin(i) - side / 2, 0);
    samples.hold(first, std::min(begin(i) + side + side / 2, rows) - first);
  }
};

}  // namespace scarp
