// Bounds of the samples of streamed rasters: tolerances and weights are read in windows, as samples are.
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

namespace scarp::metric {

/// True if streamed samples have individual bounds.
bool has_source_bounds(const SimplifyOptions& options, bool is_streamed);

class SourceBounds {
 public:
  /// `tolerances`: by sample; must outlive this. `most`: an additional bound of all samples; +infinity: none.
  SourceBounds(const SampleSource& tolerances, double most, const BoundRule& rule)
      : tolerances_(&tolerances), most_(most), rule_(rule) {}
  /// The bounds from the options, with tolerances multiplied by `factor`. The options' sources must outlive this.
  /// REQUIRES: a max error, or tolerances.
  SourceBounds(const SimplifyOptions& options, const BoundRule& rule, double factor);

  /// The targets of refinement in a window, `stride` floats a row. Fails with kUsage if a tolerance or weight is
  /// negative or NaN, or a weight is infinite; also fails if a source fails.
  Result<void> read_aims(Point first, std::int32_t cols, std::int32_t rows, float* aims, std::ptrdiff_t stride) const;
  /// The same for whole rows of these samples, from `first` on. Also fails with kPromise if a requested bound is below
  /// its sample's rounding.
  Result<void> read_aims(std::int32_t first, const grid::Raster& samples, float* aims) const;

  /// Unprocessed tolerances or weights of rows. Fails if the source fails. REQUIRES: has_values().
  Result<void> read_values(std::int32_t first, std::int32_t rows, std::int32_t cols, float* values) const;
  bool has_values() const { return tolerances_ != nullptr || weights_ != nullptr; }
  bool has_weights() const { return weights_ != nullptr; }
  /// The guaranteed bounds of the samples of a row. `values`: their tolerances or weights; empty if !has_values().
  void find_bounds(std::int32_t row, std::span<const float> values, std::span<float> bounds) const;

  /// True if the max error bounds every sample.
  bool has_most() const;

 private:
  Result<void> read(Point first, std::int32_t cols, std::int32_t rows, const grid::Raster* samples, float* aims,
                    std::ptrdiff_t stride) const;
  const SampleSource* source() const { return weights_ != nullptr ? weights_ : tolerances_; }
  /// The requested bound of a sample with this tolerance or weight, unless it is ignored.
  double asked(float value) const;

  const SampleSource* tolerances_ = nullptr;
  const SampleSource* weights_ = nullptr;
  grid::PointRows ignored_;
  double most_, factor_ = 1;
  BoundRule rule_;
};

}  // namespace scarp::metric
