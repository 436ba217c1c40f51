// The samples of a triangle in a box or along spans. Compiled once for every instruction set (scan_kernels_vector.cpp).

// As Highway wants it: seen once for every instruction set.
#if defined(SCARP_SCAN_KERNELS_BOX) == defined(HWY_TARGET_TOGGLE)
#ifdef SCARP_SCAN_KERNELS_BOX
#undef SCARP_SCAN_KERNELS_BOX
#else
#define SCARP_SCAN_KERNELS_BOX
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "geom/scan_kernels_spans.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using detail::ScanBest;
using detail::ScanTask;
using detail::Span;

/// A lane's error must exceed this to become a candidate: equal errors matter once there is a hit.
HWY_INLINE float entry(const ScanTask& task, const ScanBest& best) {
  if (!(best.error > task.floor)) return task.floor;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(best.error) - 1);
}

/// Offers the largest of `most`, where it is above `entry`, at the smallest of its lanes' places.
template <class D, class V, class P>
HWY_INLINE void offer_lanes(D d, V most, P places, float entry, ScanBest& best) {
  if (hn::AllFalse(d, hn::Gt(most, hn::Set(d, entry)))) return;
  const hn::RebindToSigned<D> di;
  const auto largest = hn::MaxOfLanes(d, most);
  const auto is_largest = hn::RebindMask(di, hn::Eq(most, largest));
  const auto none = hn::Set(di, std::numeric_limits<std::int32_t>::max());
  best.offer(hn::GetLane(largest),
             static_cast<Place>(hn::GetLane(hn::MinOfLanes(di, hn::IfThenElse(is_largest, places, none)))));
}

/// The samples of the triangle among `rows` rows from `y`, and `width` columns from `x`; reads up to 3 rows more.
template <std::size_t kLanes>
HWY_INLINE void scan_box(const TileView& tile, const ScanTask& task, std::int32_t x, std::int32_t y, std::int32_t width,
                         std::int32_t rows, ScanBest& best) {
  const hn::CappedTag<float, kLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const float start = entry(task, best);
  const auto iota = hn::Iota(di, 0);
  const auto slope_x = hn::Set(d, task.plane.slope_x), slope_y = hn::Set(d, task.plane.slope_y);
  const auto base = hn::Set(d, task.plane.height), one = hn::Set(d, 1.0f);
  const auto down_0 = hn::Set(di, task.along_y[0]), down_1 = hn::Set(di, task.along_y[1]),
             down_2 = hn::Set(di, task.along_y[2]);
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  for (std::int32_t end = x + width; x < end; x += lanes) {
    const float* samples = tile.row(y) + x;
    const auto along = hn::Mul(slope_x, hn::ConvertTo(d, hn::Add(iota, hn::Set(di, x - task.base.x))));
    auto w_0 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[0])), hn::Set(di, task.edge(0, x, y)));
    auto w_1 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[1])), hn::Set(di, task.edge(1, x, y)));
    auto w_2 = hn::Add(hn::Mul(iota, hn::Set(di, task.along_x[2])), hn::Set(di, task.edge(2, x, y)));
    auto dy = hn::Set(d, static_cast<float>(y - task.base.y));
    auto most = hn::Set(d, start), most_dy = dy;
    for (std::int32_t row = 0; row < rows; row += 4) {
      for (int unrolled = 0; unrolled < 4; ++unrolled) {
        const auto surface = hn::Add(along, hn::Mul(slope_y, dy));
        const auto error = hn::Abs(hn::Sub(surface, hn::Sub(hn::LoadU(d, samples), base)));
        const auto outside = hn::BroadcastSignBit(hn::Or(hn::Or(w_0, w_1), w_2));
        const auto is_worse = hn::AndNot(hn::MaskFromVec(hn::BitCast(d, outside)), hn::Gt(error, most));
        most = hn::IfThenElse(is_worse, error, most);
        most_dy = hn::IfThenElse(is_worse, dy, most_dy);
        samples += tile.stride;
        w_0 = hn::Add(w_0, down_0);
        w_1 = hn::Add(w_1, down_1);
        w_2 = hn::Add(w_2, down_2);
        dy = hn::Add(dy, one);
      }
    }
    const auto row = hn::Add(hn::ConvertTo(di, most_dy), hn::Set(di, task.base.y));
    const auto column = hn::Add(iota, hn::Set(di, x));
    offer_lanes(d, most, hn::Or(hn::ShiftLeft<16>(row), column), start, best);
  }
}

/// Row by row, along spans.
HWY_INLINE void scan_spans(const TileView& tile, const ScanTask& task, std::span<const Span> spans, ScanBest& best) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const float start = entry(task, best);
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto iota = hn::Iota(di, 0), step_place = hn::Set(di, lanes);
  const auto step = hn::Set(d, static_cast<float>(lanes));
  const auto slope_x = hn::Set(d, task.plane.slope_x), base = hn::Set(d, task.plane.height);
  auto most = hn::Set(d, start);
  auto places = iota;
  std::int32_t y = task.top;
  for (const Span& span : spans) {
    const auto across = hn::Set(d, task.plane.slope_y * static_cast<float>(y - task.base.y));
    const float* samples = tile.row(y) + span.first;
    auto dx = hn::ConvertTo(d, hn::Add(iota, hn::Set(di, span.first - task.base.x)));
    auto here = hn::Add(iota, hn::Set(di, static_cast<std::int32_t>(place(span.first, y))));
    std::int32_t left = span.last - span.first + 1;
    for (; left >= lanes; left -= lanes) {
      const auto surface = hn::Add(hn::Mul(slope_x, dx), across);
      const auto error = hn::Abs(hn::Sub(surface, hn::Sub(hn::LoadU(d, samples), base)));
      const auto is_worse = hn::Gt(error, most);
      most = hn::IfThenElse(is_worse, error, most);
      places = hn::IfThenElse(hn::RebindMask(di, is_worse), here, places);
      samples += lanes;
      dx = hn::Add(dx, step);
      here = hn::Add(here, step_place);
    }
    if (left > 0) {
      const auto surface = hn::Add(hn::Mul(slope_x, dx), across);
      const auto error = hn::Abs(hn::Sub(surface, hn::Sub(hn::LoadU(d, samples), base)));
      const auto covered = hn::RebindMask(d, hn::Lt(iota, hn::Set(di, left)));
      const auto is_worse = hn::And(covered, hn::Gt(error, most));
      most = hn::IfThenElse(is_worse, error, most);
      places = hn::IfThenElse(hn::RebindMask(di, is_worse), here, places);
    }
    ++y;
  }
  offer_lanes(d, most, places, start, best);
}
}  // namespace scarp::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
