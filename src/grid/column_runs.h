// Sets of samples by column, and vertical distances to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/sample_runs.h"

namespace scarp::grid {

class ColumnRuns {
 public:
  /// Rows [begin, end) of a column.
  struct Run {
    std::int32_t begin = 0, end = 0;
  };

  /// `runs`: in raster order, disjoint, in a raster of `cols` columns. Cost: O(columns + runs + resulting runs). Both
  /// numbers of runs are proportional to the length of the set's outline.
  ColumnRuns(std::span<const SampleRun> runs, std::int32_t cols);

  /// The disjoint runs of a column, from the top down.
  std::span<const Run> column(std::int32_t x) const {
    const auto i = static_cast<std::size_t>(x);
    return std::span(runs_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }
  std::uint64_t bytes() const { return runs_.capacity() * sizeof(Run) + begins_.capacity() * sizeof(std::size_t); }

 private:
  std::vector<Run> runs_;
  std::vector<std::size_t> begins_;  // start of each column's runs, and end of the last column's
};

/// Walks down a column of a set, row by row.
class ColumnWalk {
 public:
  /// The walk begins at `row`.
  ColumnWalk(std::span<const ColumnRuns::Run> column, std::int32_t row);

  /// Number of steps from `row` to the column's nearest sample in the set; −1 if there is none. REQUIRES: `row` never
  /// decreases between calls.
  std::int32_t steps_from(std::int32_t row) {
    while (next_ != end_ && next_->end <= row) ++next_;
    const std::int32_t below = next_ == end_ ? -1 : next_->begin > row ? next_->begin - row : 0;
    if (below == 0 || next_ == first_) return below;
    const std::int32_t above = row - (next_ - 1)->end + 1;
    return below < 0 || above < below ? above : below;
  }

 private:
  const ColumnRuns::Run *first_, *end_, *next_;  // next_: the first run that does not end above the row
};

}  // namespace scarp::grid
