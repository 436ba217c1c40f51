// Reads a raster's samples next to a part of it: strips of three rows or columns, one of them outside the part.
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "scarp/io.h"

namespace scarp {
namespace {

/// Cells in the part's grid, possibly outside the part.
struct Cells {
  int col = 0, row = 0, cols = 0, rows = 0;
};

/// Empty unless the raster has all these cells.
Result<OwnedHeightField> read_cells(const std::string& path, ReadOptions options, const RasterInfo& info,
                                    const Cells& cells) {
  const std::array<double, 6>& gt = info.geotransform;
  const auto [west, east] = std::minmax({gt[0] + gt[1] * cells.col, gt[0] + gt[1] * (cells.col + cells.cols)});
  const auto [south, north] = std::minmax({gt[3] + gt[5] * cells.row, gt[3] + gt[5] * (cells.row + cells.rows)});
  options.view.extent = {west, south, east, north};
  options.fill_distance = 0;
  options.as_values = true;  // a strip may have no heights
  auto strip = read_height_field(path, options);
  if (strip && (strip->cols != cells.cols || strip->rows != cells.rows)) return OwnedHeightField{};
  return strip;
}

}  // namespace

Result<BeyondEdges> read_beyond(const std::string& path, const ReadOptions& options, const RasterInfo& info, int cols,
                                int rows) {
  constexpr int kWidth = 3;  // at least two of them are in the raster
  BeyondEdges beyond;
  if (!options.view.extent) return beyond;
  struct Strip {
    std::vector<float>& edge;
    Cells cells;
    int first, step;
  };
  const Strip strips[] = {{beyond.top, {0, -1, cols, kWidth}, 0, 1},
                          {beyond.bottom, {0, rows - 2, cols, kWidth}, (kWidth - 1) * cols, 1},
                          {beyond.left, {-1, 0, kWidth, rows}, 0, kWidth},
                          {beyond.right, {cols - 2, 0, kWidth, rows}, kWidth - 1, kWidth}};
  for (const Strip& strip : strips) {
    SCARP_TRY(auto&& read, read_cells(path, options, info, strip.cells));
    if (read.samples.empty()) continue;
    for (int k = 0; k < (strip.step == 1 ? cols : rows); ++k)
      strip.edge.push_back(read.samples[static_cast<std::size_t>(strip.first + k * strip.step)]);
  }
  return beyond;
}

}  // namespace scarp
