// Bounds of the samples of streamed rasters: tolerances and weights are read in windows, as the samples are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"
#include "grid/point_rows.h"
#include "grid/raster.h"
#include "metric/bound_rule.h"
#include "scarp/height_field.h"
#include "scarp/options.h"
#include "scarp/result.h"

namespace scarp {

/// True if streamed samples have bounds of their own.
bool has_source_bounds(const SimplifyOptions& options, bool is_streamed);

class SourceBounds {
 public:
  /// `tolerances`: the request for each sample, alive. `most`: in addition; +infinity for none.
  SourceBounds(const SampleSource& tolerances, double most, const BoundRule& rule)
      : tolerances_(&tolerances), most_(most), rule_(rule) {}
  /// The bounds that the options ask for, with `factor` times the tolerances. Their sources stay alive. REQUIRES: a max
  /// error, or tolerances.
  SourceBounds(const SimplifyOptions& options, const BoundRule& rule, double factor);

  /// The aims of refinement in a window, `stride` floats a row. Fails with kUsage where a tolerance or a weight is
  /// negative, NaN or, a weight, infinite, and as the sources do.
  Result<void> read_aims(Point first, std::int32_t cols, std::int32_t rows, float* aims, std::ptrdiff_t stride) const;
  /// The same of whole rows, from `first` on, of these samples. Fails with kPromise, too, where less is asked of a
  /// sample than its rounding.
  Result<void> read_aims(std::int32_t first, const Raster& samples, float* aims) const;

  /// The tolerances or weights of rows as they are. Fails as the source does. REQUIRES: has_values().
  Result<void> read_values(std::int32_t first, std::int32_t rows, std::int32_t cols, float* values) const;
  bool has_values() const { return tolerances_ != nullptr || weights_ != nullptr; }
  bool has_weights() const { return weights_ != nullptr; }
  /// The bounds promised at the samples of a row, whose values are these; empty values where !has_values().
  void find_bounds(std::int32_t row, std::span<const float> values, std::span<float> bounds) const;

  /// True if every sample is to be within the max error.
  bool has_most() const;

 private:
  Result<void> read(Point first, std::int32_t cols, std::int32_t rows, const Raster* samples, float* aims,
                    std::ptrdiff_t stride) const;
  const SampleSource* source() const { return weights_ != nullptr ? weights_ : tolerances_; }
  /// The bound of a sample with this tolerance or weight that is not ignored.
  double asked(float value) const;

  const SampleSource* tolerances_ = nullptr;
  const SampleSource* weights_ = nullptr;
  PointRows ignored_;
  double most_, factor_ = 1;
  BoundRule rule_;
};

}  // namespace scarp
