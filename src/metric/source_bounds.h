// Per-sample tolerances of streamed rasters: read in windows, as the samples are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/point.h"
#include "grid/raster.h"
#include "metric/bound_rule.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

class SourceBounds {
 public:
  /// `tolerances`: what was asked for at each sample, alive; `factor` times that counts. `most`: beside that; +infinity
  /// for none.
  SourceBounds(const SampleSource& tolerances, double most, const BoundRule& rule, double factor = 1)
      : tolerances_(tolerances), most_(most), factor_(factor), rule_(rule) {}

  /// What refinement aims at in a window, `stride` floats a row. Fails with kUsage where a tolerance is negative or
  /// NaN, and as the source does.
  Result<void> read_aims(Point first, std::int32_t cols, std::int32_t rows, float* aims, std::ptrdiff_t stride) const;
  /// The same of whole rows, from `first` on, of these samples. Fails with kPromise, too, where less is asked of a
  /// sample than its rounding.
  Result<void> read_aims(std::int32_t first, const Raster& samples, float* aims) const;

  /// The tolerances of rows as they are. Fails as the source does.
  Result<void> read_tolerances(std::int32_t first, std::int32_t rows, std::int32_t cols, float* tolerances) const;
  /// What is promised for a tolerance.
  float bound(float tolerance) const;

  /// Whether every sample has a bound, whatever its tolerance.
  bool has_most() const;

 private:
  Result<void> read(Point first, std::int32_t cols, std::int32_t rows, const Raster* samples, float* aims,
                    std::ptrdiff_t stride) const;
  double asked(float tolerance) const;

  const SampleSource& tolerances_;
  double most_, factor_;
  BoundRule rule_;
};

}  // namespace scarp
