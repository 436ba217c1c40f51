#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "scarp/options.h"

namespace scarp {

namespace {

constexpr double kShare = 1 - 0x1p-9;
constexpr std::size_t kMostSteps = 8192;

class EdgeLine {
 public:
  EdgeLine(std::span<const float> heights, double tolerance, std::span<const double> tolerances)
      : heights_(heights), tolerance_(tolerance), tolerances_(tolerances), before_(heights.size(), kUnseen) {}

  std::vector<std::int32_t> find() {
    for (std::size_t first = 0; first < heights_.size();) {
      std::size_t end = first;
      while (end < heights_.size() && !std::isnan(heights_[end])) ++end;
      if (end > first) add_run(first, end - 1);
      first = end + 1;
    }
    return std::move(vertices_);
  }

 private:
  static constexpr std::int32_t kUnseen = -1;

  double bound(std::size_t i) const { return kShare * (tolerances_.empty() ? tolerance_ : tolerances_[i]); }

  /// Adds samples by the number of segments from `first` on, each for the lowest segment that reaches it.
  void add_run(std::size_t first, std::size_t last) {
    std::vector<std::size_t> level{first}, next;
    while (last != first && before_[last] == kUnseen) {
      next.clear();
      for (const std::size_t i : level) look_from(i, last, next);
      std::sort(next.begin(), next.end());
      level.swap(next);
    }
    const auto begin = static_cast<std::ptrdiff_t>(vertices_.size());
    for (std::size_t i = last; i != first; i = static_cast<std::size_t>(before_[i]))
      vertices_.push_back(static_cast<std::int32_t>(i));
    vertices_.push_back(static_cast<std::int32_t>(first));
    std::reverse(vertices_.begin() + begin, vertices_.end());
  }

  /// The slopes of segments from `i` that pass all samples so far within their bounds form an interval.
  void look_from(std::size_t i, std::size_t last, std::vector<std::size_t>& next) {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    const double from = heights_[i];
    for (std::size_t j = i + 1, end = std::min(last, i + kMostSteps); j <= end && low <= high; ++j) {
      const double rise = heights_[j] - from, steps = static_cast<double>(j - i), slope = rise / steps;
      if (before_[j] == kUnseen && slope >= low && slope <= high) {
        before_[j] = static_cast<std::int32_t>(i);
        next.push_back(j);
      }
      low = std::max(low, (rise - bound(j)) / steps);
      high = std::min(high, (rise + bound(j)) / steps);
    }
  }

  std::span<const float> heights_;
  double tolerance_;
  std::span<const double> tolerances_;
  std::vector<std::int32_t> before_;
  std::vector<std::int32_t> vertices_;
};

}  // namespace

std::vector<std::int32_t> simplify_edge(std::span<const float> heights, double tolerance,
                                        std::span<const double> tolerances) {
  return EdgeLine(heights, tolerance, tolerances).find();
}

}  // namespace scarp
