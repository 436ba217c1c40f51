#include "grid/sample_runs.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace scarp::grid {

void SampleRuns::add(const SampleRun& run) {
  if (runs_.size() > merged_ && runs_.back().row == run.row && run.begin <= runs_.back().end &&
      run.end >= runs_.back().begin) {
    runs_.back().begin = std::min(runs_.back().begin, run.begin);
    runs_.back().end = std::max(runs_.back().end, run.end);
    return;
  }
  // Millions of short adjacent segments add the same runs repeatedly.
  if (runs_.size() > 2 * merged_ + (1u << 16)) merge();
  runs_.push_back(run);
}

void SampleRuns::merge() {
  sort_rarely(runs_);
  std::size_t kept = 0;
  for (const SampleRun& run : runs_) {
    if (kept > 0 && runs_[kept - 1].row == run.row && run.begin <= runs_[kept - 1].end)
      runs_[kept - 1].end = std::max(runs_[kept - 1].end, run.end);
    else
      runs_[kept++] = run;
  }
  runs_.resize(kept);
  merged_ = kept;
}

SampleSet::SampleSet(std::vector<SampleRun> runs, std::int32_t rows)
    : runs_(std::move(runs)), begins_(static_cast<std::size_t>(rows) + 1, 0) {
  for (const SampleRun& run : runs_) ++begins_[static_cast<std::size_t>(run.row) + 1];
  for (std::size_t row = 1; row < begins_.size(); ++row) begins_[row] += begins_[row - 1];
}

bool SampleSet::has(Point p) const {
  const auto runs = row(p.y);
  const auto behind = std::upper_bound(runs.begin(), runs.end(), p.x,
                                       [](std::int32_t x, const SampleRun& run) { return x < run.begin; });
  return behind != runs.begin() && p.x < std::prev(behind)->end;
}

}  // namespace scarp::grid
