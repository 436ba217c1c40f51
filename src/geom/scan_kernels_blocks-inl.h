// Branch and bound over the 8 × 8 blocks. Compiled once for every instruction set (scan_kernels_vector.cpp).
//
// Bounds of the computed distance of a block's samples from the plane. f is the computed height of the plane at the
// block's centre, and M = |slope_x|·(width + 8) + |slope_y|·(height + 8) of the box. A sample's exact distance (with
// the float32 slopes) is at most B = max(high − za − f, f − (low − za)) + 3.5(|slope_x| + |slope_y|). Its computed
// error is at most B(1 + 2u) + 3uM + …, u = 2⁻²⁴, and the bound loses at most 3uB and 6uM to its own roundings. So with
// margins of 2⁻²⁰M on the bound and 2⁻²⁰ on its limit, no relevant sample is dropped; 2⁻¹⁴⁰ covers subnormal numbers.

// An include guard like Highway's: one inclusion per instruction set.
#if defined(SCARP_SCAN_KERNELS_BLOCKS) == defined(HWY_TARGET_TOGGLE)
#ifdef SCARP_SCAN_KERNELS_BLOCKS
#undef SCARP_SCAN_KERNELS_BLOCKS
#else
#define SCARP_SCAN_KERNELS_BLOCKS
#endif

#include "geom/scan_kernels_box-inl.h"
#include "geom/scan_kernels_columns.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::geom::HWY_NAMESPACE {

using detail::BlockColumns;
using detail::Span;

struct BlockBounds {
  const TileView& tile;
  const ScanTask& task;
  float extent;  ///< extent of the plane around a block's centre, plus the margin

  BlockBounds(const TileView& view, const ScanTask& scan_task) : tile(view), task(scan_task) {
    const double x = task.plane.slope_x < 0 ? -double{task.plane.slope_x} : double{task.plane.slope_x};
    const double y = task.plane.slope_y < 0 ? -double{task.plane.slope_y} : double{task.plane.slope_y};
    extent =
        static_cast<float>(3.5 * (x + y) + 0x1p-20 * (x * (task.width() + 8) + y * (task.height() + 8)) + 0x1p-140);
  }
};

/// Bounds of the blocks first … first + lanes of a row. `across`: slope_y · (centre − base).
template <class D>
HWY_INLINE hn::Vec<D> bounds_at(D d, const BlockBounds& blocks, std::int32_t row, std::int32_t first, float across) {
  const hn::RebindToSigned<D> di;
  const ScanPlane& plane = blocks.task.plane;
  const auto base = hn::Set(d, plane.height);
  const auto column = hn::ConvertTo(d, hn::Add(hn::Iota(di, 0), hn::Set(di, first)));
  const auto centre = hn::Add(hn::Mul(column, hn::Set(d, static_cast<float>(kBlock))),
                              hn::Set(d, 3.5f - static_cast<float>(blocks.task.base.x)));
  const auto surface = hn::Add(hn::Mul(hn::Set(d, plane.slope_x), centre), hn::Set(d, across));
  const std::ptrdiff_t at = row * blocks.tile.block_stride + first;
  const auto above = hn::Sub(hn::Sub(hn::LoadU(d, blocks.tile.block_high + at), base), surface);
  const auto below = hn::Sub(surface, hn::Sub(hn::LoadU(d, blocks.tile.block_low + at), base));
  return hn::Add(larger_of(above, below), hn::Set(d, blocks.extent));
}

HWY_INLINE float across_of(const ScanTask& task, std::int32_t row) {
  return task.plane.slope_y * (static_cast<float>(row * kBlock - task.base.y) + 3.5f);
}

/// A block with a smaller bound cannot contain a better sample.
HWY_INLINE float limit_of(const ScanBest& best) { return best.error * (1 - 0x1p-20f); }

struct RowBound {
  float bound;
  std::int32_t block;  ///< the first block with that bound
  Span columns;
};

HWY_INLINE RowBound bound_row(const BlockBounds& blocks, std::int32_t row, Span columns) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const float across = across_of(blocks.task, row);
  const auto last = hn::Set(di, columns.last), step = hn::Set(di, lanes);
  auto column = hn::Add(hn::Iota(di, 0), hn::Set(di, columns.first));
  auto most = hn::Set(d, -1.0f);
  auto at = column;
  for (std::int32_t x = columns.first; x <= columns.last; x += lanes) {
    const auto bound = bounds_at(d, blocks, row, x, across);
    const auto is_more = hn::AndNot(hn::RebindMask(d, hn::Gt(column, last)), hn::Gt(bound, most));
    most = hn::IfThenElse(is_more, bound, most);
    at = hn::IfThenElse(hn::RebindMask(di, is_more), column, at);
    column = hn::Add(column, step);
  }
  const auto largest = hn::MaxOfLanes(d, most);
  const auto none = hn::Set(di, std::numeric_limits<std::int32_t>::max());
  const auto first = hn::MinOfLanes(di, hn::IfThenElse(hn::RebindMask(di, hn::Eq(most, largest)), at, none));
  return {hn::GetLane(largest), hn::GetLane(first), columns};
}

HWY_NOINLINE void scan_block(const TileView& tile, const ScanTask& task, std::int32_t row, std::int32_t column,
                             ScanBest& best) {
  scan_box<8>(tile, task, column * kBlock, row * kBlock, kBlock, kBlock, best);
}

/// Scans the blocks of a row that can still matter, except the block already scanned. Returns the number scanned.
HWY_INLINE std::uint64_t scan_block_row(const BlockBounds& blocks, std::int32_t row, const RowBound& bounds,
                                        ScanBest& best) {
  const hn::CappedTag<float, 16> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const float across = across_of(blocks.task, row);
  float bound[HWY_MAX_BYTES / sizeof(float)];
  std::uint64_t scanned = 0;
  for (std::int32_t x = bounds.columns.first; x <= bounds.columns.last; x += lanes) {
    const auto these = bounds_at(d, blocks, row, x, across);
    if (hn::AllFalse(d, hn::Ge(these, hn::Set(d, limit_of(best))))) continue;
    hn::StoreU(these, d, bound);
    for (std::int32_t i = 0; i < lanes && x + i <= bounds.columns.last; ++i) {
      if (x + i == bounds.block || bound[i] < limit_of(best)) continue;
      scan_block(blocks.tile, blocks.task, row, x + i, best);
      ++scanned;
    }
  }
  return scanned;
}

/// The order of the search: hints, the best block of all, the best block of each row, the rest. Each step reduces the
/// work of the next. The order does not depend on the number of lanes.
HWY_NOINLINE std::uint64_t scan_blocks(const TileView& tile, const ScanTask& task,
                                       const std::array<TilePoint, 3>& corners, std::span<const TilePoint> hints,
                                       ScanBest& best) {
  for (const TilePoint hint : hints) {
    const Point p = point_of(hint);
    if (task.covers(p)) best.offer(task.error(p.x, p.y, tile.at(hint)), hint);
  }
  const BlockBounds blocks(tile, task);
  const BlockColumns columns(task, corners);
  RowBound rows[kMaxTileSide / kBlock + 1];
  const std::int32_t first = task.top / kBlock, count = task.bottom / kBlock - first + 1;
  std::uint64_t bounded = 0, scanned = 0;
  std::int32_t top = 0;
  rows[0] = {-1, 0, {0, -1}};
  for (std::int32_t k = 0; k < count; ++k) {
    rows[k] = bound_row(blocks, first + k, columns.of(first + k));
    bounded += static_cast<std::uint64_t>(rows[k].columns.last - rows[k].columns.first + 1);
    if (rows[k].bound > rows[top].bound) top = k;
  }
  if (rows[top].bound < limit_of(best)) return bounded;
  scan_block(tile, task, first + top, rows[top].block, best);
  ++scanned;
  for (std::int32_t k = 0; k < count; ++k) {
    if (k == top || rows[k].bound < limit_of(best)) continue;
    scan_block(tile, task, first + k, rows[k].block, best);
    ++scanned;
  }
  for (std::int32_t k = 0; k < count; ++k) {
    if (!(rows[k].bound < limit_of(best))) scanned += scan_block_row(blocks, first + k, rows[k], best);
  }
  return bounded + scanned * kBlock * kBlock;
}

}  // namespace scarp::geom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
