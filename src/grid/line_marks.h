// Samples in polygons and on lines.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "grid/affine_map.h"
#include "grid/sample_runs.h"
#include "scarp/lines.h"

namespace scarp::grid {

/// Marks samples as runs. Memory grows with the length of the lines.
class LineRuns {
 public:
  /// Initially marks nothing. `affine`: maps samples to the coordinates of the lines.
  LineRuns(const std::array<double, 6>& affine, int cols, int rows) : to_samples_(affine), cols_(cols), rows_(rows) {}

  /// Marks the samples nearest to points along a line. These points are at most a quarter of a sample apart. `reach`:
  /// the largest distance of a marked sample from the line, in samples.
  void add_course(const Line& line, double reach = 1);
  /// Marks the samples inside polygons, by the even-odd rule for the rings of each polygon. Open lines contain nothing.
  void add_polygons(std::span<const Line> lines);

  /// All samples marked so far, in raster order, as disjoint runs.
  const std::vector<SampleRun>& runs() {
    runs_.merge();
    return runs_.all();
  }

 private:
  SamplePosition position_of(const std::array<double, 3>& point) const {
    return to_samples_.position(point[0], point[1]);
  }
  void fill(const std::vector<const Line*>& rings, int begin, int end);

  MapToSamples to_samples_;
  int cols_, rows_;
  SampleRuns runs_;
};

}  // namespace scarp::grid
