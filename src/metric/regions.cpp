// Distances follow P. F. Felzenszwalb and D. P. Huttenlocher, "Distance Transforms of Sampled Functions", Theory of
// Computing 8, 2012: the lower envelope of parabolas along each row, above the distances along the columns. The
// envelope is built in stretches of a row that do not depend on the window, so its rounding does not either.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel.h"
#include "grid/column_runs.h"
#include "grid/line_marks.h"
#include "metric/bound_rule.h"
#include "scarp/tolerances.h"

namespace scarp {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();
constexpr std::int32_t kLeastStretch = 1024;  // samples of a row

/// Squared distances along a row of samples that are `cell` apart: the minimum over all places of height + (cell ·
/// steps)².
class Envelope {
 public:
  Envelope(std::size_t most, double cell) : cell_(cell), lows_(most), from_(most + 1) {}

  void clear() { count_ = 0; }
  bool is_empty() const { return count_ == 0; }
  /// REQUIRES: places are added from left to right.
  void add(std::int32_t x, double height) {
    double begins = -kFarAway;
    for (; count_ > 0; --count_) {
      begins = crossing(lows_[count_ - 1], {x, height});
      if (begins > from_[count_ - 1]) break;
      begins = -kFarAway;
    }
    lows_[count_] = {x, height};
    from_[count_++] = begins;
  }
  /// Calls each(x, squared distance) for x in [begin, end). REQUIRES: not empty.
  template <class Each>
  void visit(std::int32_t begin, std::int32_t end, const Each& each) {
    from_[count_] = kFarAway;
    std::size_t k = 0;
    for (std::int32_t x = begin; x < end; ++x) {
      while (from_[k + 1] < x) ++k;
      const double away = cell_ * (x - lows_[k].x);
      each(x, lows_[k].height + away * away);
    }
  }

  static constexpr std::size_t kBytes = 24;  // per place

 private:
  struct Low {
    std::int32_t x;
    double height;
  };
  /// The x at which the parabola of b falls below that of a, which lies to the left of b.
  double crossing(const Low& a, const Low& b) const {
    const double x = a.x, y = b.x;
    return ((b.height - a.height) / (cell_ * cell_) + (y * y - x * x)) / (2 * (y - x));
  }

  double cell_;
  std::vector<Low> lows_;
  std::vector<double> from_;
  std::size_t count_ = 0;
};

/// Width of `falloff` in samples, at most one side.
std::int32_t reach_of(double falloff, double cell, int side) {
  return static_cast<std::int32_t>(std::min(std::ceil(falloff / cell), double{1} * side));
}

struct SampleWindow {
  std::int32_t col, row, cols, rows;
};

/// One region's samples and their surroundings.
class RegionSamples {
 public:
  /// REQUIRES: the region has runs.
  RegionSamples(std::span<const grid::SampleRun> runs, double tolerance, const RegionGrid& grid)
      : grid_(grid),
        columns_(runs, grid.cols),
        tolerance_(tolerance),
        reach_(reach_of(grid.falloff, grid.cell_x, grid.cols)),
        stretch_(std::max(kLeastStretch, 4 * std::min(reach_, std::numeric_limits<std::int32_t>::max() / 8))) {
    const std::int32_t up = reach_of(grid.falloff, grid.cell_y, grid.rows);
    top_ = std::max(runs.front().row - up, 0);
    bottom_ = runs.back().row >= grid.rows - up ? grid.rows : runs.back().row + up + 1;
    left_ = grid.cols;
    for (const grid::SampleRun& run : runs) {
      left_ = std::min(left_, run.begin);
      right_ = std::max(right_, run.end);
    }
  }

  std::uint64_t bytes() const { return columns_.bytes(); }
  std::uint64_t bytes_to_read() const {
    return (Envelope::kBytes + sizeof(grid::ColumnWalk)) * static_cast<std::uint64_t>(widest());
  }

  /// Lowers the bounds of samples in a window.
  void lower(const SampleWindow& window, float* out, std::ptrdiff_t stride) const {
    const std::int32_t first = std::max(window.row, top_), last = std::min(window.row + window.rows, bottom_);
    if (first >= last) return;
    Envelope envelope(widest(), grid_.cell_x);
    std::vector<grid::ColumnWalk> walks;
    walks.reserve(widest());
    const std::int32_t end = window.col + window.cols;
    // Without a falloff, columns are independent.
    for (std::int32_t begin = reach_ == 0 ? window.col : window.col / stretch_ * stretch_; begin < end;) {
      const std::int32_t next = begin > grid_.cols - stretch_ ? grid_.cols : begin + stretch_;
      const std::int32_t left = std::max(begin - reach_, left_);
      const std::int32_t right = reach_ == 0 ? std::min({next, right_, end}) : std::min(next, right_ - reach_) + reach_;
      if (left < right) {
        walks.clear();
        for (std::int32_t x = left; x < right; ++x) walks.emplace_back(columns_.column(x), first);
        const std::int32_t from = std::max(begin, window.col), to = std::min(next, end);
        for (std::int32_t y = first; y < last; ++y)
          lower_row(y, walks, {left, from, to}, envelope, out + (y - window.row) * stride - window.col);
      }
      begin = next;
    }
  }

 private:
  /// Ranges of columns: for the first walk, and for the samples to lower.
  struct Stretch {
    std::int32_t left, from, to;
  };

  std::size_t widest() const {
    return static_cast<std::size_t>(
        std::min<std::int64_t>(std::int64_t{stretch_} + 2 * std::int64_t{reach_}, grid_.cols));
  }

  void lower_row(std::int32_t y, std::vector<grid::ColumnWalk>& walks, const Stretch& at, Envelope& envelope,
                 float* bounds) const {
    envelope.clear();
    for (std::size_t k = 0; k < walks.size(); ++k) {
      const std::int32_t steps = walks[k].steps_from(y);
      const double away = grid_.cell_y * steps;
      if (steps == 0 || (steps > 0 && away < grid_.falloff)) envelope.add(static_cast<std::int32_t>(k), away * away);
    }
    if (envelope.is_empty()) return;
    const double beyond = grid_.beyond.value_or(kFarAway);
    envelope.visit(at.from - at.left, at.to - at.left, [&](std::int32_t k, double squared) {
      float& bound = bounds[at.left + k];
      const double away = std::sqrt(squared);
      if (away == 0)
        bound = std::min(bound, metric::round_down_to_float(tolerance_));
      else if (away < grid_.falloff)
        bound =
            std::min(bound, metric::round_down_to_float(tolerance_ + (beyond - tolerance_) * (away / grid_.falloff)));
    });
  }

  RegionGrid grid_;
  grid::ColumnRuns columns_;
  double tolerance_;
  std::int32_t reach_, stretch_;   // along a row
  std::int32_t top_, bottom_;      // rows of samples that may be lowered
  std::int32_t left_, right_ = 0;  // columns of the samples in the region
};

class RegionSource final : public SampleSource {
 public:
  RegionSource(std::vector<RegionSamples> regions, double beyond)
      : regions_(std::move(regions)), beyond_(metric::round_down_to_float(beyond)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    for (int y = 0; y < rows; ++y) std::fill_n(out + y * stride, cols, beyond_);
    for (const RegionSamples& region : regions_) region.lower({col, row, cols, rows}, out, stride);
    return {};
  }
  bool is_in_memory() const override { return false; }

 private:
  std::vector<RegionSamples> regions_;
  float beyond_;
};

}  // namespace

RegionBounds make_region_bounds(std::span<const Region> regions, const RegionGrid& grid, int threads) {
  RegionBounds bounds;
  std::uint64_t to_read = 0;
  std::vector<RegionSamples> found;
  for (const Region& region : regions) {
    grid::LineRuns runs(grid.affine, grid.cols, grid.rows);
    for (const Line& line : region.lines) runs.add_course(line);
    runs.add_polygons(region.lines);
    bounds.found.push_back(!runs.runs().empty());
    if (runs.runs().empty()) continue;
    found.emplace_back(runs.runs(), region.tolerance, grid);
    bounds.bytes += found.back().bytes();
    to_read = std::max(to_read, found.back().bytes_to_read());
  }
  bounds.bytes += to_read * static_cast<std::uint64_t>(thread_count(threads));
  bounds.source = std::make_shared<RegionSource>(std::move(found), grid.beyond.value_or(kFarAway));
  return bounds;
}

std::vector<float> region_tolerances(std::span<const Region> regions, const RegionGrid& grid,
                                     std::vector<bool>* found) {
  RegionBounds bounds = make_region_bounds(regions, grid);
  if (found != nullptr) *found = std::move(bounds.found);
  std::vector<float> tolerances(static_cast<std::size_t>(grid.cols) * static_cast<std::size_t>(grid.rows));
  static_cast<void>(bounds.source->read(0, 0, grid.cols, grid.rows, tolerances.data(), grid.cols));  // cannot fail
  return tolerances;
}

}  // namespace scarp
