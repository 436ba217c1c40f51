// Judging a mesh at scattered points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/array.h"
#include "grid/snapped_points.h"
#include "measure/error_summary.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// The part of measure_points() that follows after duplicates have been resolved.
Result<Measurement> judge_points(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
                                 const MeasureOptions& options);

/// The statistics of the errors of many points.
class ErrorTally {
 public:
  /// `errors`: NaN for uncovered points, which are not counted. Returns the index of the first point with the largest
  /// error so far, if it is in `errors`.
  std::optional<std::size_t> add(std::span<const double> errors);
  /// Sets the number of samples and the statistics, but not max_error_at.
  void finish(Measurement& result) const;

 private:
  Histogram histogram_;
  Array<std::uint32_t> room_;
  Sum error_, magnitude_, square_;
  std::uint64_t samples_ = 0;
  double largest_ = -1;
};

}  // namespace scarp::judge
