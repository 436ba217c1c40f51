// Samples in polygons and on lines.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "grid/affine_map.h"
#include "grid/sample_runs.h"
#include "scarp/lines.h"

namespace scarp {

/// Lines as runs: their memory grows with the length of the lines.
class LineRuns {
 public:
  /// No sample is marked. `affine`: from samples to the coordinates of the lines.
  LineRuns(const std::array<double, 6>& affine, int cols, int rows) : to_samples_(affine), cols_(cols), rows_(rows) {}

  /// Marks the samples nearest to a line: to points of it, a quarter of a sample apart at most. `reach`: only those no
  /// farther from it, in samples.
  void add_course(const Line& line, double reach = 1);
  /// Marks the samples that polygons hold, those of each by its rings, even-odd. Lines that are no rings hold nothing.
  void add_polygons(std::span<const Line> lines);

  /// All samples marked so far, in raster order, apart from each other.
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

}  // namespace scarp
