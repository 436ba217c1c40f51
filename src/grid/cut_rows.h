// The outline of a cut by rows: on which side of it each sample lies, and which samples are near what stays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/point.h"
#include "grid/raster.h"
#include "grid/sample_runs.h"

namespace scarp {

/// On which side of a cut a sample lies.
enum class CutSide : std::uint8_t { kBeyond, kOnWall, kWithin };

class CutRows {
 public:
  /// `outline`: pairs of points in kLatticeSteps, the edges at which a polygon or its complement ends, complete within
  /// the raster's rectangle up to its sides; which side stays does not matter. Memory: some 40 bytes for each row of
  /// samples that an edge crosses or runs along, half of it while this is made, and 24 for each row.
  CutRows(std::span<const std::array<Point, 2>> outline, std::int32_t cols, std::int32_t rows);

  /// The side of a sample. Cost: O(log(crossings of its row)).
  CutSide side(Point sample) const;

  /// Makes samples of a window nodata (NaN) that no cell near the cut surface has: those of the cells that it lies in
  /// or touches stay, and those of the cells around them, so that heights between samples and normals are what they
  /// were. `samples`: row-major, `stride` floats from row to row. Whatever the window, a sample's fate is the same.
  /// Cost: O(samples made nodata + crossings of the rows).
  void mask_beyond(std::int32_t col, std::int32_t row, std::int32_t cols, std::int32_t rows, float* samples,
                   std::ptrdiff_t stride) const;

  /// True if a cell that the cut surface lies in or touches has three heights. `raster`: all of it.
  bool has_surface(const Raster& raster) const;

 private:
  void add_held(std::int32_t row, SampleRuns& cells) const;
  SampleRuns near_cells(std::int32_t row) const;

  std::int32_t cols_, rows_;
  SampleSet within_, on_;  // samples
  SampleSet cells_;        // cells that the outline passes, each at its first sample
};

}  // namespace scarp
