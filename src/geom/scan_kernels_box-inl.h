// The samples of a triangle in a box. Compiled once for every instruction set (scan_kernels_vector.cpp).

// An include guard like Highway's: one inclusion per instruction set.
#if defined(SCARP_SCAN_KERNELS_BOX) == defined(HWY_TARGET_TOGGLE)
#ifdef SCARP_SCAN_KERNELS_BOX
#undef SCARP_SCAN_KERNELS_BOX
#else
#define SCARP_SCAN_KERNELS_BOX
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "base/bits.h"
#include "base/wasm_vectors-inl.h"
#include "geom/scan_kernels_task.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::geom::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using detail::ScanBest;
using detail::ScanTask;
using scarp::HWY_NAMESPACE::larger_of;
using scarp::HWY_NAMESPACE::none_of;
using scarp::HWY_NAMESPACE::smaller_of;
using scarp::HWY_NAMESPACE::take_larger;

/// The value that a lane's error must exceed to become a candidate. After a hit, equal errors are candidates too.
HWY_INLINE float entry(const ScanTask& task, const ScanBest& best) {
  if (!(best.error > task.floor)) return task.floor;
  return bit_cast<float>(bit_cast<std::uint32_t>(best.error) - 1);
}

/// The largest error of each lane above `start`, and its position; a lane without such an error has `start` and any
/// point.
template <class D>
struct Farthest {
  hn::Vec<D> error;
  hn::Vec<hn::RebindToSigned<D>> at;

  HWY_INLINE Farthest(D d, float start)
      : error(hn::Set(d, start)), at(hn::Set(hn::RebindToSigned<D>(), std::numeric_limits<std::int32_t>::max())) {}

  HWY_INLINE void merge(D d, hn::Vec<D> other, hn::Vec<hn::RebindToSigned<D>> place) {
    const hn::RebindToSigned<D> di;
    const auto is_first = hn::And(hn::Eq(other, error), hn::RebindMask(d, hn::Lt(place, at)));
    const auto is_more = hn::Or(hn::Gt(other, error), is_first);
    error = hn::IfThenElse(is_more, other, error);
    at = hn::IfThenElse(hn::RebindMask(di, is_more), place, at);
  }
  HWY_INLINE void offer_to(D d, float start, ScanBest& best) const {
    if (none_of(d, hn::Gt(error, hn::Set(d, start)))) return;
    const hn::RebindToSigned<D> di;
    const auto largest = hn::MaxOfLanes(d, error);
    const auto none = hn::Set(di, std::numeric_limits<std::int32_t>::max());
    const auto places = hn::IfThenElse(hn::RebindMask(di, hn::Eq(error, largest)), at, none);
    best.offer(hn::GetLane(largest), static_cast<TilePoint>(hn::GetLane(hn::MinOfLanes(di, places))));
  }
};

/// Scans one vector of columns from `x`, in `rows` rows from `y`; reads up to 3 more rows.
template <class D>
HWY_INLINE void scan_strip(D d, const TileView& tile, const ScanTask& task, std::int32_t x, std::int32_t y,
                           std::int32_t rows, float start, Farthest<D>& farthest) {
  const hn::RebindToSigned<D> di;
  const auto iota = hn::Iota(di, 0);
  const auto slope_y = hn::Set(d, task.plane.slope_y);
  const auto base = hn::Set(d, task.plane.height), one = hn::Set(d, 1.0f);
  const auto down_0 = hn::Set(di, task.along_y[0]), down_1 = hn::Set(di, task.along_y[1]),
             down_2 = hn::Set(di, task.along_y[2]);
  const float* samples = tile.row(y) + x;
  const auto along =
      hn::Mul(hn::Set(d, task.plane.slope_x), hn::ConvertTo(d, hn::Add(iota, hn::Set(di, x - task.base.x))));
  auto w_0 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[0])), hn::Set(di, task.edge(0, x, y)));
  auto w_1 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[1])), hn::Set(di, task.edge(1, x, y)));
  auto w_2 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[2])), hn::Set(di, task.edge(2, x, y)));
  auto dy = hn::Set(d, static_cast<float>(y - task.base.y));
  const auto sign = hn::SignBit(d);
  auto most = hn::Set(d, start), most_dy = dy;
  for (std::int32_t row = 0; row < rows; row += 4) {
    for (int unrolled = 0; unrolled < 4; ++unrolled) {
      const auto surface = hn::Add(along, hn::Mul(slope_y, dy));
      const auto error = hn::Sub(surface, hn::Sub(hn::LoadU(d, samples), base));
      // Outside the triangle a weight is negative. This makes the error negative, so the sample is no candidate.
      const auto weights = hn::BitCast(d, hn::Or(hn::Or(w_0, w_1), w_2));
      take_larger(hn::Or(hn::AndNot(sign, error), hn::And(sign, weights)), dy, most, most_dy);
      samples += tile.stride;
      w_0 = hn::Add(w_0, down_0);
      w_1 = hn::Add(w_1, down_1);
      w_2 = hn::Add(w_2, down_2);
      dy = hn::Add(dy, one);
    }
  }
  const auto row = hn::Add(hn::ConvertTo(di, most_dy), hn::Set(di, task.base.y));
  farthest.merge(d, most, hn::Or(hn::ShiftLeft<16>(row), hn::Add(iota, hn::Set(di, x))));
}

/// Scans the triangle's samples in `rows` rows from `y` and `width` columns from `x`; reads up to 3 more rows.
template <std::size_t kLanes>
HWY_INLINE void scan_box(const TileView& tile, const ScanTask& task, std::int32_t x, std::int32_t y, std::int32_t width,
                         std::int32_t rows, ScanBest& best) {
  const hn::CappedTag<float, kLanes> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const float start = entry(task, best);
  Farthest farthest(d, start);
  for (const std::int32_t end = x + width; x < end; x += lanes) scan_strip(d, tile, task, x, y, rows, start, farthest);
  farthest.offer_to(d, start, best);
}

/// For each strip of a vector's width, the rows of the box that can contain samples of the triangle: a superset.
struct StripRows {
  const ScanTask& task;
  float x_low[3], x_high[3], x[3], y[3], slant[3];  ///< data of the edge from corner i to the next

  HWY_INLINE StripRows(const ScanTask& scan_task, const std::array<TilePoint, 3>& corners) : task(scan_task) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = point_of(corners[i]), to = point_of(corners[i == 2 ? 0 : i + 1]);
      x[i] = static_cast<float>(from.x);
      y[i] = static_cast<float>(from.y);
      x_low[i] = static_cast<float>(from.x < to.x ? from.x : to.x);
      x_high[i] = static_cast<float>(from.x < to.x ? to.x : from.x);
      slant[i] = from.x == to.x ? 0 : static_cast<float>(to.y - from.y) / static_cast<float>(to.x - from.x);
    }
  }

  /// Rows first … last of one strip per lane; the first strip starts at column `left`.
  template <class D>
  HWY_INLINE void of(D d, std::int32_t left, std::int32_t* first, std::int32_t* last) const {
    const hn::RebindToSigned<D> di;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    const auto strip_left = hn::ConvertTo(d, hn::Add(hn::Mul(hn::Iota(di, 0), hn::Set(di, lanes)), hn::Set(di, left)));
    const auto strip_right = hn::Add(strip_left, hn::Set(d, static_cast<float>(lanes - 1)));
    auto top = hn::Set(d, static_cast<float>(task.bottom)), bottom = hn::Set(d, static_cast<float>(task.top));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = larger_of(strip_left, hn::Set(d, x_low[i])),
                 to = smaller_of(strip_right, hn::Set(d, x_high[i]));
      const auto meets = hn::Le(from, to);
      const auto corner_x = hn::Set(d, x[i]), corner_y = hn::Set(d, y[i]), by = hn::Set(d, slant[i]);
      const auto y_from = hn::Add(corner_y, hn::Mul(by, hn::Sub(from, corner_x)));
      const auto y_to = hn::Add(corner_y, hn::Mul(by, hn::Sub(to, corner_x)));
      top = hn::IfThenElse(meets, smaller_of(top, smaller_of(y_from, y_to)), top);
      bottom = hn::IfThenElse(meets, larger_of(bottom, larger_of(y_from, y_to)), bottom);
    }
    // Slant, product and sum lose at most 2⁻¹² each, since an edge spans at most 2¹² rows. The margin exceeds four
    // times their sum, which also covers its own roundings and those of the conversion.
    const auto margin = hn::Set(d, 0x1p-8f), one = hn::Set(d, 1.0f);
    hn::StoreU(hn::Max(hn::Set(di, task.top), hn::ConvertTo(di, hn::Add(hn::Sub(top, margin), one))), di, first);
    hn::StoreU(hn::Min(hn::Set(di, task.bottom), hn::ConvertTo(di, hn::Add(bottom, margin))), di, last);
  }
};

/// Scans strip by strip, each only as long as the triangle in it.
HWY_NOINLINE void scan_strips(const TileView& tile, const ScanTask& task, const std::array<TilePoint, 3>& corners,
                              ScanBest& best) {
  const hn::CappedTag<float, 16> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const StripRows strip_rows(task, corners);
  const float start = entry(task, best);
  Farthest farthest(d, start);
  std::int32_t first[HWY_MAX_BYTES / sizeof(float)], last[HWY_MAX_BYTES / sizeof(float)];
  for (std::int32_t x = task.left; x <= task.right; x += lanes * lanes) {
    strip_rows.of(d, x, first, last);
    for (std::int32_t i = 0; i < lanes && x + i * lanes <= task.right; ++i)
      scan_strip(d, tile, task, x + i * lanes, first[i], last[i] - first[i] + 1, start, farthest);
  }
  farthest.offer_to(d, start, best);
}

}  // namespace scarp::geom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
