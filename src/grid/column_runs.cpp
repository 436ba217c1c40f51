#include "grid/column_runs.h"

#include <algorithm>

namespace scarp::grid {
namespace {

using RowRuns = std::span<const SampleRun>;

/// Calls each(x) for the columns of `runs` that are not in `others`, the runs of another row.
template <class Each>
void for_each_only_in(RowRuns runs, RowRuns others, const Each& each) {
  auto other = others.begin();
  for (const SampleRun& run : runs) {
    while (other != others.end() && other->end <= run.begin) ++other;
    std::int32_t x = run.begin;
    for (auto hole = other; x < run.end; ++hole) {
      const bool is_last = hole == others.end() || hole->begin >= run.end;
      for (const std::int32_t stop = is_last ? run.end : hole->begin; x < stop; ++x) each(x);
      if (is_last) break;
      x = hole->end;
    }
  }
}

/// Calls end(x, begin, end) for each run of each column, from the top down.
template <class End>
void for_each_column_run(RowRuns runs, std::int32_t cols, const End& end) {
  std::vector<std::int32_t> begun(static_cast<std::size_t>(cols));
  RowRuns above;
  const auto finish = [&](RowRuns row, std::int32_t y) {
    for_each_only_in(above, row, [&](std::int32_t x) { end(x, begun[static_cast<std::size_t>(x)], y); });
  };
  for (std::size_t first = 0; first < runs.size();) {
    std::size_t last = first;
    const std::int32_t y = runs[first].row;
    while (last < runs.size() && runs[last].row == y) ++last;
    const RowRuns row = runs.subspan(first, last - first);
    if (!above.empty() && above.front().row + 1 < y) {
      finish({}, above.front().row + 1);
      above = {};
    }
    finish(row, y);
    for_each_only_in(row, above, [&](std::int32_t x) { begun[static_cast<std::size_t>(x)] = y; });
    above = row;
    first = last;
  }
  if (!above.empty()) finish({}, above.front().row + 1);
}

}  // namespace

ColumnRuns::ColumnRuns(std::span<const SampleRun> runs, std::int32_t cols)
    : begins_(static_cast<std::size_t>(cols) + 1, 0) {
  for_each_column_run(runs, cols,
                      [&](std::int32_t x, std::int32_t, std::int32_t) { ++begins_[static_cast<std::size_t>(x) + 1]; });
  for (std::size_t x = 1; x < begins_.size(); ++x) begins_[x] += begins_[x - 1];
  runs_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for_each_column_run(runs, cols, [&](std::int32_t x, std::int32_t begin, std::int32_t end) {
    runs_[next[static_cast<std::size_t>(x)]++] = {begin, end};
  });
}

ColumnWalk::ColumnWalk(std::span<const ColumnRuns::Run> column, std::int32_t row)
    : first_(column.data()), end_(column.data() + column.size()) {
  next_ = std::upper_bound(first_, end_, row, [](std::int32_t y, const ColumnRuns::Run& run) { return y < run.end; });
}

}  // namespace scarp::grid
