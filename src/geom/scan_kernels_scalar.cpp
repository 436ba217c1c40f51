#include <limits>

#include "geom/scan.h"
#include "geom/scan_kernels_task.h"

namespace scarp::geom::detail {

namespace {

std::uint64_t scan(const TileView& tile, double threshold, std::span<const std::array<TilePoint, 3>> triangles,
                   std::span<const TilePoint>, ScanHit* hits) {
  std::uint64_t scanned = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::array<TilePoint, 3>& corners = triangles[i];
    const ScanTask task(tile, corners, threshold);
    ScanBest best{task.floor, 0};
    scan_rows({point_of(corners[0]), point_of(corners[1]), point_of(corners[2])},
              [&](std::int32_t y, std::int32_t first, std::int32_t last) {
                for (std::int32_t x = first; x <= last; ++x)
                  best.offer(task.error(x, y, tile.row(y)[x]), tile_point(x, y));
                scanned += static_cast<std::uint64_t>(last - first + 1);
              });
    hits[i] = task.hit(best);
  }
  return scanned;
}

float fill_blocks(const TileView& tile, float* low, float* high, std::uint64_t& nodata) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float most = 0;
  nodata = 0;
  for (std::int32_t top = 0; top < tile.rows; top += kBlock) {
    float* const low_row = low + top / kBlock * tile.block_stride;
    float* const high_row = high + top / kBlock * tile.block_stride;
    std::fill_n(low_row, tile.block_stride, kInfinity);
    std::fill_n(high_row, tile.block_stride, -kInfinity);
    for (std::int32_t y = top; y < std::min(top + kBlock, tile.rows); ++y) {
      for (std::int32_t x = 0; x < tile.cols; ++x) {
        const float sample = tile.row(y)[x];
        nodata += std::isnan(sample);
        if (sample < low_row[x / kBlock]) low_row[x / kBlock] = sample;
        if (sample > high_row[x / kBlock]) high_row[x / kBlock] = sample;
        if (std::abs(sample) > most) most = std::abs(sample);
      }
    }
  }
  return most;
}

bool scan_row(const float* samples, std::int32_t count, double base, double slope, double offset, double& worst,
              std::int32_t& at) {
  bool found = false;
  for (std::int32_t x = 0; x < count; ++x) {
    const double error = std::abs(base + slope * (offset + x) - double{samples[x]});
    if (error > worst) {
      worst = error;
      at = x;
      found = true;
    }
  }
  return found;
}

}  // namespace

const ScanKernels& scalar_scan_kernels() {
  static constexpr ScanKernels kernels{"SCALAR", scan, fill_blocks, scan_row};
  return kernels;
}

}  // namespace scarp::geom::detail
