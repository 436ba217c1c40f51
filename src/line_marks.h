// Samples in polygons and on lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/affine_map.h"
#include "scarp/lines.h"

namespace scarp {

class LineMarks {
 public:
  /// No sample is marked. `affine`: from samples to the coordinates of the lines.
  LineMarks(const std::array<double, 6>& affine, int cols, int rows);

  /// Marks the samples nearest to a line: to points of it, a quarter of a sample apart at most. `reach`: only those no
  /// farther from it, in samples.
  void add_course(const Line& line, double reach = 1);
  /// Marks the samples that polygons hold, those of each by its rings, even-odd. Lines that are no rings hold nothing.
  void add_polygons(std::span<const Line> lines);

  bool any() const;
  bool has(std::size_t i) const { return marks_[i] != 0; }

 private:
  SamplePlace place_of(const std::array<double, 3>& point) const { return to_samples_.place(point[0], point[1]); }
  static bool narrow(double from, double span, int size, double& begin, double& end);
  void mark(int col, int row);
  void fill(const std::vector<const Line*>& rings);

  MapToSamples to_samples_;
  int cols_, rows_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace scarp
