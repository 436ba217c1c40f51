// The outline of a cut, stored by rows: finds the side of each sample, and the samples near the remaining surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/point.h"
#include "grid/raster.h"
#include "grid/sample_runs.h"

namespace scarp::grid {

/// The side of a cut on which a sample lies.
enum class CutSide : std::uint8_t { kBeyond, kOnWall, kWithin };

class CutRows {
 public:
  /// `outline`: the edges of a polygon or its complement, as pairs of points in lattice steps. It must be complete
  /// within the raster's rectangle. The surface may remain on either side. Memory: 24 bytes per row, plus about 40
  /// bytes for each row that an edge crosses or follows, half of them only during construction.
  CutRows(std::span<const std::array<Point, 2>> outline, std::int32_t cols, std::int32_t rows);

  /// The side of a sample. Cost: O(log(crossings of its row)).
  CutSide side(Point sample) const;

  /// Masks samples of a window as nodata (NaN) unless they belong to a cell near the cut surface. Such a cell contains
  /// or touches the surface, or adjoins a cell that does, so that interpolated heights and normals do not change.
  /// `samples`: row-major, `stride` floats from row to row. The result for a sample does not depend on the window.
  /// Cost: O(samples masked + crossings of the rows).
  void mask_beyond(std::int32_t col, std::int32_t row, std::int32_t cols, std::int32_t rows, float* samples,
                   std::ptrdiff_t stride) const;

  /// True if a cell that contains or touches the cut surface has at least three heights. `raster`: the whole raster.
  bool has_surface(const Raster& raster) const;

 private:
  void add_held(std::int32_t row, SampleRuns& cells) const;
  SampleRuns near_cells(std::int32_t row) const;

  std::int32_t cols_, rows_;
  SampleSet within_, on_;  // samples
  SampleSet cells_;        // cells crossed by the outline, each given by its first sample
};

}  // namespace scarp::grid
