#include <algorithm>

#include "base/int128.h"
#include "geom/segments.h"

namespace scarp::geom {
namespace {

/// numerator / denominator, the latter positive; both fit 33 bits.
struct Ratio {
  std::int64_t numerator, denominator;
};

bool operator<(Ratio a, Ratio b) { return Int128{a.numerator} * b.denominator < Int128{b.numerator} * a.denominator; }

/// base + span · at, rounded to the nearest integer, halves up.
std::int32_t rounded(std::int64_t base, std::int64_t span, Ratio at) {
  const Int128 twice = Int128{2} * span * at.numerator + at.denominator, divisor = Int128{2} * at.denominator;
  Int128 quotient = twice / divisor;
  if (quotient * divisor > twice) --quotient;
  return static_cast<std::int32_t>(base + static_cast<std::int64_t>(quotient));
}

Point point_at(const Segment& s, Ratio at) {
  return {rounded(s.from.x, std::int64_t{s.to.x} - s.from.x, at),
          rounded(s.from.y, std::int64_t{s.to.y} - s.from.y, at)};
}

double value(Ratio at) { return static_cast<double>(at.numerator) / static_cast<double>(at.denominator); }

/// Narrows [begin, end] to the t for which from + span · t lies in [0, most]. Returns false if there are none.
bool narrow(std::int64_t from, std::int64_t span, std::int64_t most, Ratio& begin, Ratio& end) {
  if (span == 0) return from >= 0 && from <= most;
  const Ratio enter = span > 0 ? Ratio{-from, span} : Ratio{from - most, -span};
  const Ratio leave = span > 0 ? Ratio{most - from, span} : Ratio{from, -span};
  if (begin < enter) begin = enter;
  if (leave < end) end = leave;
  return !(end < begin);
}

}  // namespace

bool clip_segment(const Segment& segment, std::int32_t width, std::int32_t height, ClippedSegment& clipped) {
  const auto [from, to] = segment;
  const auto is_within = [&](Point p) { return p.x >= 0 && p.x <= width && p.y >= 0 && p.y <= height; };
  if (is_within(from) && is_within(to)) {
    clipped = {segment, 0, 1};
    return from != to;
  }
  Ratio begin{0, 1}, end{1, 1};
  if (!narrow(from.x, std::int64_t{to.x} - from.x, width, begin, end) ||
      !narrow(from.y, std::int64_t{to.y} - from.y, height, begin, end))
    return false;
  clipped = {{point_at(segment, begin), point_at(segment, end)}, value(begin), value(end)};
  return clipped.segment.from != clipped.segment.to;
}

}  // namespace scarp::geom
