// The blocks of a triangle in each row of blocks. Private to the scan kernels; independent of the instruction set.
#pragma once

#include "geom/scan_kernels_task.h"

namespace scarp::geom::detail {

/// Columns or rows from the first to the last; first > last if empty.
struct Span {
  std::int32_t first, last;
};

/// The columns of blocks that can contain samples of the triangle: a superset.
class BlockColumns {
 public:
  BlockColumns(const ScanTask& task, const std::array<TilePoint, 3>& corners);

  /// Blocks first … last of a row of blocks that meets the triangle's box.
  Span of(std::int32_t block_row) const;

 private:
  const ScanTask& task_;
  std::array<Point, 3> corners_;
  std::array<double, 3> slant_;  ///< x per row, along the edge from corner i to the next
};

}  // namespace scarp::geom::detail
