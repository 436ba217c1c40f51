#include "grid/edge_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/norm.h"

namespace scarp {

namespace {

constexpr double kShare = 1 - 0x1p-9;
constexpr std::size_t kMostSteps = 8192, kMostStepsOfSeveral = 256;

class EdgeLine {
 public:
  EdgeLine(std::span<const grid::EdgeField> fields, Norm norm, double tolerance, std::span<const double> tolerances)
      : fields_(fields),
        norm_(norm),
        heights_(fields.front().values),
        tolerance_(tolerance),
        tolerances_(tolerances),
        before_(heights_.size(), kUnseen) {
    for (std::vector<std::int32_t>* reached : {&level_, &next_}) reached->reserve(heights_.size());
  }

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

  /// Adds the vertices of a line with the fewest segments from `first` to `last`, found by breadth-first search.
  void add_run(std::size_t first, std::size_t last) {
    level_.assign(1, static_cast<std::int32_t>(first));
    while (last != first && before_[last] == kUnseen) {
      next_.clear();
      for (const std::int32_t i : level_) {
        if (fields_.size() == 1 && fields_.front().scale == 1)
          look_from(static_cast<std::size_t>(i), last);
        else
          look_from_norm(static_cast<std::size_t>(i), last);
      }
      std::sort(next_.begin(), next_.end());
      level_.swap(next_);
    }
    const auto begin = static_cast<std::ptrdiff_t>(vertices_.size());
    for (std::size_t i = last; i != first; i = static_cast<std::size_t>(before_[i]))
      vertices_.push_back(static_cast<std::int32_t>(i));
    vertices_.push_back(static_cast<std::int32_t>(first));
    std::reverse(vertices_.begin() + begin, vertices_.end());
  }

  /// Finds the samples that a segment from `i` reaches. The slopes that pass all previous samples within their bounds
  /// form an interval.
  void look_from(std::size_t i, std::size_t last) {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    const double from = heights_[i];
    for (std::size_t j = i + 1, end = std::min(last, i + kMostSteps); j <= end && low <= high; ++j) {
      const double rise = heights_[j] - from, steps = static_cast<double>(j - i), slope = rise / steps;
      if (before_[j] == kUnseen && slope >= low && slope <= high) reach(j, i);
      low = std::max(low, (rise - bound(j)) / steps);
      high = std::min(high, (rise + bound(j)) / steps);
    }
  }

  /// The norm is at least each field's error, so each field alone bounds the slopes.
  void look_from_norm(std::size_t i, std::size_t last) {
    struct Slopes {
      double low = -std::numeric_limits<double>::infinity(), high = -low;
    };
    std::vector<Slopes> slopes(fields_.size());
    const auto is_open = [&] {
      return std::all_of(slopes.begin(), slopes.end(), [](const Slopes& s) { return s.low <= s.high; });
    };
    for (std::size_t j = i + 1, end = std::min(last, i + kMostStepsOfSeveral); j <= end && is_open(); ++j) {
      if (before_[j] == kUnseen && passes(i, j)) reach(j, i);
      const double steps = static_cast<double>(j - i);
      for (std::size_t f = 0; f < fields_.size(); ++f) {
        const auto& [values, scale] = fields_[f];
        if (scale == 0) continue;
        const double rise = double{values[j]} - double{values[i]}, room = bound(j) / scale;
        slopes[f].low = std::max(slopes[f].low, (rise - room) / steps);
        slopes[f].high = std::min(slopes[f].high, (rise + room) / steps);
      }
    }
  }

  void reach(std::size_t sample, std::size_t from) {
    before_[sample] = static_cast<std::int32_t>(from);
    next_.push_back(static_cast<std::int32_t>(sample));
  }

  bool passes(std::size_t a, std::size_t b) const {
    for (std::size_t i = a + 1; i < b; ++i) {
      const double error = grid::chord_error(fields_, norm_, static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
                                             static_cast<std::int32_t>(i));
      if (error > bound(i)) return false;
    }
    return true;
  }

  std::span<const grid::EdgeField> fields_;
  Norm norm_;
  std::span<const float> heights_;
  double tolerance_;
  std::span<const double> tolerances_;
  std::vector<std::int32_t> before_;
  std::vector<std::int32_t> level_, next_;  ///< samples reached by n segments, and by n + 1
  std::vector<std::int32_t> vertices_;
};

}  // namespace

double grid::chord_error(std::span<const EdgeField> fields, Norm norm, std::int32_t a, std::int32_t b, std::int32_t i) {
  double total = 0;
  for (const auto& [values, scale] : fields) {
    const double error = std::abs(chord_value(values, a, b, i) - double{values[static_cast<std::size_t>(i)]});
    total = add_to_norm_of(norm, total, scale * error);
  }
  return total;
}

std::vector<std::int32_t> grid::simplify_edge(std::span<const EdgeField> fields, Norm norm, double tolerance,
                                              std::span<const double> tolerances) {
  return EdgeLine(fields, norm, tolerance, tolerances).find();
}

std::vector<std::int32_t> simplify_edge(std::span<const float> heights, double tolerance,
                                        std::span<const double> tolerances) {
  const grid::EdgeField field{heights};
  return grid::simplify_edge(std::span(&field, 1), Norm::kMax, tolerance, tolerances);
}

}  // namespace scarp
