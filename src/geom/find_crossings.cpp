// A tree of boxes finds pairs of segments. Long segments are divided into pieces of the mean length, so that boxes fit
// closely; there are at most twice as many pieces as segments. Neighbours in the tree share a query, unless it finds
// too many boxes.
#include <algorithm>
#include <cstdlib>

#include "base/box_tree.h"
#include "base/function_ref.h"
#include "base/int128.h"
#include "base/radix_sort.h"
#include "geom/segments.h"

namespace scarp::geom {
namespace {

std::int64_t length(const Segment& s) {
  return std::max(std::int64_t{std::abs(s.to.x - s.from.x)}, std::int64_t{std::abs(s.to.y - s.from.y)});
}

/// Bounds of the k-th of n pieces of the interval from a to b, both included.
std::pair<std::int32_t, std::int32_t> piece(std::int32_t a, std::int32_t b, std::int64_t k, std::int64_t n) {
  const std::int64_t span = std::abs(b - a), low = span * k / n, high = (span * (k + 1) + n - 1) / n;
  return a <= b ? std::pair{static_cast<std::int32_t>(a + low), static_cast<std::int32_t>(a + high)}
                : std::pair{static_cast<std::int32_t>(a - high), static_cast<std::int32_t>(a - low)};
}

struct BoxedPieces {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> owners;
};

BoxedPieces cut(std::span<const Segment> segments) {
  std::int64_t total = 0;
  for (const Segment& s : segments) total += length(s);
  const std::int64_t longest = std::max<std::int64_t>(1, total / std::max<std::int64_t>(1, std::ssize(segments)) + 1);
  BoxedPieces pieces;
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

/// base + span · numerator / denominator; halves are rounded up, or down if requested.
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

  void assess(std::uint32_t a, std::uint32_t b) {
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

  /// Thousands of lines through one point produce millions of pairs.
  void tidy() {
    sort_uniquely(found_.points);
    next_tidying_ = std::max(next_tidying_, 2 * found_.points.size());
  }

  std::span<const Segment> segments_;
  std::size_t first_rigid_;
  Crossings found_;
  std::size_t next_tidying_ = std::size_t{1} << 20;
};

/// Calls visit(a, b) for the indices of each two overlapping boxes.
template <class Visit>
void visit_overlaps(const BoxTree& tree, const Visit& visit) {
  constexpr std::size_t kMostGathered = 64;
  std::vector<std::size_t> near;
  for (std::size_t group = 0; group < tree.group_count(); ++group) {
    const std::size_t begin = group * BoxTree::kGroup, end = std::min(begin + BoxTree::kGroup, tree.order().size());
    const bool is_near = tree.gather(tree.hull_of_group(group), begin, kMostGathered, near);
    for (std::size_t place = begin; place < end; ++place) {
      const Box& box = tree.box_at(place);
      if (!is_near) tree.gather(box, place + 1, tree.order().size(), near);
      for (const std::size_t other : near) {
        if (other > place && overlaps(box, tree.box_at(other))) visit(place, other);
      }
    }
  }
}

}  // namespace

void visit_neighbours(std::span<const Segment> segments, FunctionRef<void(std::uint32_t, std::uint32_t)> visit) {
  const BoxedPieces pieces = cut(segments);
  const BoxTree tree(pieces.boxes);
  visit_overlaps(tree, [&](std::size_t a, std::size_t b) {
    const std::uint32_t one = pieces.owners[tree.order()[a]], other = pieces.owners[tree.order()[b]];
    if (one != other) visit(one, other);
  });
}

Crossings find_crossings(std::span<const Segment> lines, std::span<const Segment> rigid) {
  std::vector<Segment> segments(lines.begin(), lines.end());
  segments.insert(segments.end(), rigid.begin(), rigid.end());
  Finder finder(segments, lines.size());
  visit_neighbours(segments, [&](std::uint32_t a, std::uint32_t b) { finder.assess(a, b); });
  return finder.take();
}

}  // namespace scarp::geom
