// The scan kernels in vectors, compiled once for every instruction set through Highway.
//
// Vectors have at most 16 lanes, so that TileView's padding suffices; any number of lanes is correct. Between
// HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE there must be no lambdas and no standard library functions: they would
// be compiled for one instruction set and linked for all.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geom/scan_kernels_columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geom/scan_kernels_vector.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geom/scan_kernels_blocks-inl.h"
#include "geom/scan_kernels_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::geom::HWY_NAMESPACE {

/// Boxes up to this many samples are scanned whole, larger ones by blocks.
constexpr std::int32_t kMaxBoxArea = 4096;

std::uint64_t scan(const TileView& tile, double threshold, std::span<const std::array<TilePoint, 3>> triangles,
                   std::span<const TilePoint> hints, ScanHit* hits) {
  std::uint64_t scanned = 0;
  for (const std::array<TilePoint, 3>& corners : triangles) {
    const ScanTask task(tile, corners, threshold);
    const std::int32_t width = task.width(), height = task.height();
    ScanBest best{task.floor, 0};
    if (width <= 8) {
      scan_box<8>(tile, task, task.left, task.top, width, height, best);
      scanned += static_cast<std::uint64_t>(width * height);
    } else if (width <= 16) {
      scan_box<16>(tile, task, task.left, task.top, width, height, best);
      scanned += static_cast<std::uint64_t>(width * height);
    } else if (width * height <= kMaxBoxArea) {
      scan_strips(tile, task, corners, best);
      scanned += static_cast<std::uint64_t>(width * height);
    } else {
      scanned += scan_blocks(tile, task, corners, hints, best);
    }
    *hits++ = task.hit(best);
  }
  return scanned;
}

/// Smallest and largest height of one block; ignores and counts NaN.
template <class D>
HWY_INLINE void fill_block(D d, const float* samples, std::ptrdiff_t stride, std::int32_t cols, std::int32_t rows,
                           float& low, float& high, std::uint64_t& nodata) {
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  auto lowest = infinity, highest = hn::Neg(infinity);
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  for (std::int32_t x = 0; x < cols; x += lanes) {
    const auto inside = hn::FirstN(d, static_cast<std::size_t>(cols - x < lanes ? cols - x : lanes));
    for (std::int32_t y = 0; y < rows; ++y) {
      const auto sample = hn::LoadU(d, samples + y * stride + x);
      lowest = hn::IfThenElse(hn::And(inside, hn::Lt(sample, lowest)), sample, lowest);
      highest = hn::IfThenElse(hn::And(inside, hn::Gt(sample, highest)), sample, highest);
      nodata += hn::CountTrue(d, hn::And(inside, hn::IsNaN(sample)));
    }
  }
  low = hn::GetLane(hn::MinOfLanes(d, lowest));
  high = hn::GetLane(hn::MaxOfLanes(d, highest));
}

float fill_blocks(const TileView& tile, float* low, float* high, std::uint64_t& nodata) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const hn::CappedTag<float, 8> d;
  float most = 0;
  nodata = 0;
  for (std::int32_t y = 0; y < tile.rows; y += kBlock) {
    const std::int32_t rows = tile.rows - y < kBlock ? tile.rows - y : kBlock;
    std::ptrdiff_t block = 0;
    for (std::int32_t x = 0; x < tile.cols; x += kBlock, ++block) {
      const std::int32_t cols = tile.cols - x < kBlock ? tile.cols - x : kBlock;
      fill_block(d, tile.row(y) + x, tile.stride, cols, rows, low[block], high[block], nodata);
      if (high[block] > most) most = high[block];
      if (-low[block] > most) most = -low[block];
    }
    for (; block < tile.block_stride; ++block) {
      low[block] = kInfinity;
      high[block] = -kInfinity;
    }
    low += tile.block_stride;
    high += tile.block_stride;
  }
  return most;
}

bool scan_row(const float* samples, std::int32_t count, double base, double slope, double offset, double& worst,
              std::int32_t& at) {
  std::int32_t x = 0;
  bool found = false;
#if SCARP_HAVE_FLOAT64
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> df;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto base_height = hn::Set(d, base), slopes = hn::Set(d, slope), step = hn::Set(d, static_cast<double>(lanes));
  auto along = hn::Add(hn::Iota(d, 0), hn::Set(d, offset));
  auto most = hn::Set(d, worst), most_along = along;
  for (; x + lanes <= count; x += lanes) {
    const auto sample = hn::PromoteTo(d, hn::LoadU(df, samples + x));
    const auto error = hn::Abs(hn::Sub(hn::Add(base_height, hn::Mul(slopes, along)), sample));
    const auto is_worse = hn::Gt(error, most);
    most = hn::IfThenElse(is_worse, error, most);
    most_along = hn::IfThenElse(is_worse, along, most_along);
    along = hn::Add(along, step);
  }
  if (!hn::AllFalse(d, hn::Gt(most, hn::Set(d, worst)))) {
    const auto largest = hn::MaxOfLanes(d, most);
    worst = hn::GetLane(largest);
    const auto none = hn::Set(d, std::numeric_limits<double>::max());
    const auto first = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(most, largest), most_along, none));
    at = static_cast<std::int32_t>(hn::GetLane(first) - offset);
    found = true;
  }
#endif
  for (; x < count; ++x) {
    const double along_x = slope * (offset + x);
    const double signed_error = base + along_x - double{samples[x]};
    const double error = signed_error < 0 ? -signed_error : signed_error;
    if (error > worst) {
      worst = error;
      at = x;
      found = true;
    }
  }
  return found;
}

const ScanKernels& kernels() {
  static const ScanKernels table{hwy::TargetName(HWY_TARGET), scan, fill_blocks, scan_row};
  return table;
}

}  // namespace scarp::geom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace scarp::geom::detail {

namespace {

/// The kernels of `table` that run on this machine, in its order.
std::vector<ScanKernels> find_kernels() {
  const std::int64_t supported = hwy::SupportedTargets();
  std::vector<ScanKernels> found;
  const auto add = [&](std::int64_t target, const ScanKernels& kernels) {
    if ((supported & target) != 0) found.push_back(kernels);
  };
#define SCARP_INSTRUCTION_SET(target, set) add(target, set::kernels());
#include "base/each_instruction_set.inc"
  return found;
}

}  // namespace

std::span<const ScanKernels> vector_scan_kernels() {
  static const std::vector<ScanKernels> found = find_kernels();
  return found;
}

}  // namespace scarp::geom::detail

#endif
