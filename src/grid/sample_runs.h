// Sets of samples, stored by rows. The memory of a set depends only on its outline.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"

namespace scarp::grid {

/// Samples [begin, end) of a row.
struct SampleRun {
  std::int32_t row = 0, begin = 0, end = 0;
  friend auto operator<=>(const SampleRun&, const SampleRun&) = default;  ///< raster order
};

class SampleRuns {
 public:
  /// REQUIRES: the run lies in the raster.
  void add(const SampleRun& run);
  /// Sorts runs into raster order and makes them disjoint. Cost: O(n log n) for n runs added.
  void merge();

  /// The runs added; after merge(), sorted and disjoint.
  const std::vector<SampleRun>& all() const { return runs_; }

 private:
  std::vector<SampleRun> runs_;
  std::size_t merged_ = 0;  // number of runs after the last merge()
};

/// A set of samples for many queries.
class SampleSet {
 public:
  /// Makes the set for a raster of `rows` rows. `runs`: in raster order, disjoint.
  SampleSet(std::vector<SampleRun> runs, std::int32_t rows);

  bool has(Point p) const;
  /// The runs of a row.
  std::span<const SampleRun> row(std::int32_t y) const {
    return std::span(runs_).subspan(begins_[static_cast<std::size_t>(y)],
                                    begins_[static_cast<std::size_t>(y) + 1] - begins_[static_cast<std::size_t>(y)]);
  }

 private:
  std::vector<SampleRun> runs_;
  std::vector<std::size_t> begins_;  // start of each row's runs, and end of the last row's
};

}  // namespace scarp::grid
