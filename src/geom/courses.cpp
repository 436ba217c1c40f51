#include "geom/courses.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/radix_sort.h"
#include "base/sort.h"

namespace scarp::geom {
namespace {

/// A segment on its line, given by the line's primitive direction and its distance from (0, 0) in those units.
struct OnLine {
  Point direction;
  std::int64_t offset;
  Segment segment;  ///< `from` precedes `to`
};

OnLine on_line(Segment s) {
  if (before(s.to, s.from)) std::swap(s.from, s.to);
  const std::int32_t x = s.to.x - s.from.x, y = s.to.y - s.from.y, factor = std::gcd(x, y);
  const Point direction{x / factor, y / factor};
  return {direction, std::int64_t{direction.x} * s.from.y - std::int64_t{direction.y} * s.from.x, s};
}

bool same_line(const OnLine& a, const OnLine& b) { return a.direction == b.direction && a.offset == b.offset; }

/// A hash that is equal for segments of one line, and rarely equal for others.
std::uint32_t mark_of(const OnLine& line) {
  std::uint64_t bits =
      std::uint64_t{static_cast<std::uint32_t>(line.direction.x)} << 32 | static_cast<std::uint32_t>(line.direction.y);
  bits = (bits ^ bits >> 29) * 0xbf58476d1ce4e5b9 + static_cast<std::uint64_t>(line.offset);
  bits = (bits ^ bits >> 32) * 0x94d049bb133111eb;
  return static_cast<std::uint32_t>(bits >> 32);
}

class Merger {
 public:
  explicit Merger(std::span<const Segment> segments) : lines_(segments.size()), leaders_(segments.size()) {
    std::transform(segments.begin(), segments.end(), lines_.begin(), on_line);
    std::iota(leaders_.begin(), leaders_.end(), 0u);
  }

  Courses merge() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> marks(lines_.size());
    for (std::uint32_t k = 0; k < marks.size(); ++k) marks[k] = {mark_of(lines_[k]), k};
    radix_sort(marks, [](const auto& mark) { return mark.first; });
    std::vector<std::uint32_t> alike;
    for (std::size_t begin = 0, end = 0; begin < marks.size(); begin = end) {
      while (end < marks.size() && marks[end].first == marks[begin].first) ++end;
      if (end - begin == 1) continue;
      alike.clear();
      for (std::size_t k = begin; k < end; ++k) alike.push_back(marks[k].second);
      unite(alike);
    }
    return take();
  }

 private:
  /// Unites overlapping segments among those with equal marks.
  void unite(std::vector<std::uint32_t>& alike) {
    sort_rarely(alike, [this](std::uint32_t i, std::uint32_t j) {
      const OnLine &a = lines_[i], &b = lines_[j];
      if (a.direction != b.direction) return before(a.direction, b.direction);
      if (a.offset != b.offset) return a.offset < b.offset;
      return a.segment.from != b.segment.from ? before(a.segment.from, b.segment.from) : i < j;
    });
    for (std::size_t begin = 0, end = 0; begin < alike.size(); begin = end) {
      OnLine whole = lines_[alike[begin]];
      for (end = begin + 1; end < alike.size(); ++end) {
        const OnLine& next = lines_[alike[end]];
        if (!same_line(whole, next) || !before(next.segment.from, whole.segment.to)) break;
        if (before(whole.segment.to, next.segment.to)) whole.segment.to = next.segment.to;
      }
      const auto first = alike.begin() + static_cast<std::ptrdiff_t>(begin),
                 last = alike.begin() + static_cast<std::ptrdiff_t>(end);
      const std::uint32_t leader = *std::min_element(first, last);
      for (auto k = first; k != last; ++k) leaders_[*k] = leader;
      lines_[leader] = whole;
    }
  }

  Courses take() const {
    Courses courses;
    courses.of.resize(lines_.size());
    for (std::uint32_t k = 0; k < lines_.size(); ++k) {
      if (leaders_[k] == k) {
        courses.of[k] = static_cast<std::uint32_t>(courses.segments.size());
        courses.segments.push_back(lines_[k].segment);
      } else {
        courses.of[k] = courses.of[leaders_[k]];
      }
    }
    return courses;
  }

  std::vector<OnLine> lines_;
  std::vector<std::uint32_t> leaders_;  ///< leader of each segment: the lowest of those united with it
};

}  // namespace

Courses merge_overlaps(std::span<const Segment> segments) { return Merger(segments).merge(); }

}  // namespace scarp::geom
