// Pairs of segments come from a tree of boxes. Two measures keep the number of pairs down: segments that lie upon each
// other become one, and long ones are cut into pieces of the mean length, so that a box holds little but its segment;
// together there are at most twice as many pieces as segments.
#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "base/int128.h"
#include "geom/box_tree.h"
#include "geom/segments.h"

namespace scarp {
namespace {

/// A segment on its line: the line's direction without a common factor and its distance from (0, 0) in those terms.
struct OnLine {
  Point direction;
  std::int64_t offset;
  Segment segment;  ///< from before to
};

OnLine on_line(Segment s) {
  if (before(s.to, s.from)) std::swap(s.from, s.to);
  const std::int32_t x = s.to.x - s.from.x, y = s.to.y - s.from.y, factor = std::gcd(x, y);
  const Point direction{x / factor, y / factor};
  return {direction, std::int64_t{direction.x} * s.from.y - std::int64_t{direction.y} * s.from.x, s};
}

bool same_line(const OnLine& a, const OnLine& b) { return a.direction == b.direction && a.offset == b.offset; }

/// The unions of segments of one line that have more than a point in common.
std::vector<Segment> merge_overlaps(std::span<const Segment> segments) {
  std::vector<OnLine> sorted(segments.size());
  std::transform(segments.begin(), segments.end(), sorted.begin(), on_line);
  std::sort(sorted.begin(), sorted.end(), [](const OnLine& a, const OnLine& b) {
    if (a.direction != b.direction) return before(a.direction, b.direction);
    if (a.offset != b.offset) return a.offset < b.offset;
    return before(a.segment.from, b.segment.from);
  });
  std::vector<Segment> merged;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const Segment& s = sorted[k].segment;
    if (k > 0 && same_line(sorted[k - 1], sorted[k]) && before(s.from, merged.back().to)) {
      if (before(merged.back().to, s.to)) merged.back().to = s.to;
    } else {
      merged.push_back(s);
    }
  }
  return merged;
}

std::int64_t length(const Segment& s) {
  return std::max(std::int64_t{std::abs(s.to.x - s.from.x)}, std::int64_t{std::abs(s.to.y - s.from.y)});
}

/// A box around the k-th of n pieces of the stretch from a to b, both included.
std::pair<std::int32_t, std::int32_t> piece(std::int32_t a, std::int32_t b, std::int64_t k, std::int64_t n) {
  const std::int64_t span = std::abs(b - a), low = span * k / n, high = (span * (k + 1) + n - 1) / n;
  return a <= b ? std::pair{static_cast<std::int32_t>(a + low), static_cast<std::int32_t>(a + high)}
                : std::pair{static_cast<std::int32_t>(a - high), static_cast<std::int32_t>(a - low)};
}

struct Pieces {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> owners;
};

Pieces cut(std::span<const Segment> segments) {
  std::int64_t total = 0;
  for (const Segment& s : segments) total += length(s);
  const std::int64_t longest = std::max<std::int64_t>(1, total / std::max<std::int64_t>(1, std::ssize(segments)) + 1);
  Pieces pieces;
  for (std::uint32_t k = 0; k < segments.size(); ++k) {
    const auto& [from, to] = segments[k];
    const std::int64_t count = (length(segments[k]) + longest - 1) / longest;
    for (std::int64_t n = 0; n < count; ++n) {
      const auto [x0, x1] = piece(from.x, to.x, n, count);
      const auto [y0, y1] = piece(from.y, to.y, n, count);
      pieces.boxes.push_back({x0, y0, x1, y1});
      pieces.owners.push_back(k);
    }
  }
  return pieces;
}

struct Rounded {
  std::int32_t value;
  bool is_exact;
};

/// base + span · numerator / denominator; halves go up, or down if asked to.
template <class Int>
Rounded rounded(std::int32_t base, std::int32_t span, std::int64_t numerator, std::int64_t denominator,
                bool half_down) {
  const Int product = Int{span} * numerator, divisor = Int{2} * denominator;
  const Int twice = 2 * product + denominator - (half_down ? 1 : 0);
  Int quotient = twice / divisor;
  if (quotient * divisor > twice) --quotient;
  return {static_cast<std::int32_t>(base + static_cast<std::int64_t>(quotient)), quotient * denominator == product};
}

Rounded rounded(std::int32_t base, std::int32_t span, std::int64_t numerator, std::int64_t denominator,
                bool half_down) {
  constexpr std::int64_t kMostSpan = std::int64_t{1} << 20, kMostDenominator = std::int64_t{1} << 41;
  if (std::abs(span) <= kMostSpan && denominator <= kMostDenominator)
    return rounded<std::int64_t>(base, span, numerator, denominator, half_down);
  return rounded<Int128>(base, span, numerator, denominator, half_down);
}

class Finder {
 public:
  Finder(std::span<const Segment> segments, std::size_t first_rigid) : segments_(segments), first_rigid_(first_rigid) {}

  void judge(std::uint32_t a, std::uint32_t b) {
    const Segment &s = segments_[a], &t = segments_[b];
    const std::int64_t before_t = orient(s.from, s.to, t.from), behind_t = orient(s.from, s.to, t.to);
    if (sign_of(before_t) * sign_of(behind_t) >= 0) return;
    if (sign_of(orient(t.from, t.to, s.from)) * sign_of(orient(t.from, t.to, s.to)) >= 0) return;
    const std::int64_t numerator = std::abs(before_t), denominator = numerator + std::abs(behind_t);
    const bool on_s = is_rigid_antidiagonal(a), on_t = is_rigid_antidiagonal(b);
    const Rounded x = rounded(t.from.x, t.to.x - t.from.x, numerator, denominator, on_s || on_t);
    Rounded y = rounded(t.from.y, t.to.y - t.from.y, numerator, denominator, false);
    if (on_s || on_t) y.value = (on_s ? s.from.x + s.from.y : t.from.x + t.from.y) - x.value;
    found_.are_exact = found_.are_exact && x.is_exact && y.is_exact;
    found_.points.push_back({x.value, y.value});
    if (found_.points.size() >= next_tidying_) tidy();
  }

  Crossings take() {
    tidy();
    return std::move(found_);
  }

 private:
  bool is_rigid_antidiagonal(std::uint32_t k) const { return k >= first_rigid_ && is_antidiagonal(segments_[k]); }

  /// Thousands of lines through one point are millions of pairs.
  void tidy() {
    std::sort(found_.points.begin(), found_.points.end(), before);
    found_.points.erase(std::unique(found_.points.begin(), found_.points.end()), found_.points.end());
    next_tidying_ = std::max(next_tidying_, 2 * found_.points.size());
  }

  std::span<const Segment> segments_;
  std::size_t first_rigid_;
  Crossings found_;
  std::size_t next_tidying_ = std::size_t{1} << 20;
};

}  // namespace

Crossings find_crossings(std::span<const Segment> lines, std::span<const Segment> rigid) {
  std::vector<Segment> segments = merge_overlaps(lines);
  const std::size_t first_rigid = segments.size();
  const std::vector<Segment> merged_rigid = merge_overlaps(rigid);
  segments.insert(segments.end(), merged_rigid.begin(), merged_rigid.end());

  const Pieces pieces = cut(segments);
  const BoxTree tree(pieces.boxes);
  Finder finder(segments, first_rigid);
  for (std::size_t place = 0; place < tree.order().size(); ++place) {
    const Box& box = tree.box_at(place);
    const std::uint32_t owner = pieces.owners[tree.order()[place]];
    tree.visit([&](const Box& other) { return overlaps(box, other); },
               [&](std::uint32_t other) {
                 if (pieces.owners[other] != owner) finder.judge(owner, pieces.owners[other]);
               },
               place + 1);
  }
  return finder.take();
}

}  // namespace scarp
