#include "scarp/tolerances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "base/clock.h"

namespace scarp {
namespace {

constexpr float kNoTolerance = std::numeric_limits<float>::infinity();

/// Number of rows with about `samples` samples.
int rows_of(int samples, int cols) { return std::max(1, samples / cols); }

/// The tolerance for a raster value. `is_rounded`: the value was rounded to float32, maybe to above the file's value.
float tolerance_of_value(float value, bool is_rounded) {
  if (std::isnan(value)) return kNoTolerance;
  return is_rounded ? std::nextafter(value, 0.0F) : value;  // at most the value in the file
}

/// Converts the values of an opened raster by `meaning`.
class RasterValues final : public SampleSource {
 public:
  using Meaning = std::function<float(float)>;
  RasterValues(OwnedHeightField values, Meaning meaning) : values_(std::move(values)), meaning_(std::move(meaning)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    if (values_.source) {
      SCARP_RETURN_IF_ERROR(values_.source->read(col, row, cols, rows, out, stride));
    }
    for (int y = 0; y < rows; ++y) {
      float* to = out + y * stride;
      if (!values_.source) std::copy_n(&values_.samples[index(col, row + y)], cols, to);
      std::transform(to, to + cols, to, meaning_);
    }
    return {};
  }
  bool is_in_memory() const override { return !values_.source || values_.source->is_in_memory(); }

 private:
  std::size_t index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(values_.cols) + static_cast<std::size_t>(col);
  }
  OwnedHeightField values_;
  Meaning meaning_;
};

class LeastTolerances final : public SampleSource {
 public:
  LeastTolerances(std::shared_ptr<const SampleSource> a, std::shared_ptr<const SampleSource> b)
      : a_(std::move(a)), b_(std::move(b)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(a_->read(col, row, cols, rows, out, stride));
    constexpr int kSamples = 1 << 14;
    const int most = std::min(rows_of(kSamples, cols), rows);
    std::vector<float> other(static_cast<std::size_t>(most) * static_cast<std::size_t>(cols));
    for (int first = 0; first < rows; first += most) {
      const int count = std::min(most, rows - first);
      SCARP_RETURN_IF_ERROR(b_->read(col, row + first, cols, count, other.data(), cols));
      for (int y = 0; y < count; ++y) {
        float* to = out + (first + y) * stride;
        const float* from = other.data() + static_cast<std::ptrdiff_t>(y) * cols;
        for (int x = 0; x < cols; ++x) to[x] = std::min(to[x], from[x]);
      }
    }
    return {};
  }
  bool is_in_memory() const override { return a_->is_in_memory() && b_->is_in_memory(); }

 private:
  std::shared_ptr<const SampleSource> a_, b_;
};

tl::unexpected<Error> refuse_negative(const OwnedHeightField& raster, float value, int row, std::size_t behind) {
  const auto at = static_cast<std::int64_t>(behind);
  return fail(ErrorKind::kInput, fmt::format("{}: the value {} at column {}, row {} is negative: it must be at least 0",
                                             raster.info.path, value, at % raster.cols, row + at / raster.cols));
}

/// Reports at intervals how far a raster has been scanned.
class LookProgress {
 public:
  explicit LookProgress(const ProgressCallback& progress) : progress_(progress) {}
  Result<void> report(const OwnedHeightField& raster, int row) {
    constexpr double kSecondsBetween = 0.1;
    if (!progress_ || seconds_since(last_) < kSecondsBetween) return {};
    last_ = Clock::now();
    Progress now;
    now.pass = "read";
    now.fraction = static_cast<double>(row) / raster.rows;
    if (progress_(now)) return {};
    return fail(ErrorKind::kCancelled, raster.info.path + ": reading was cancelled");
  }

 private:
  const ProgressCallback& progress_;
  Clock::time_point last_ = Clock::now();
};

/// Scans all values from the top, some rows at a time, and rejects negative values. Returns the largest; none if no
/// value is valid.
Result<std::optional<float>> look_through(const OwnedHeightField& raster, const ProgressCallback& progress) {
  constexpr int kSamples = 1 << 18;
  const int most = rows_of(kSamples, raster.cols);
  std::vector<float> buffer;
  std::optional<float> largest;
  LookProgress look(progress);
  for (int row = 0, rows; row < raster.rows; row += rows) {
    rows = std::min(most, raster.rows - row);
    const std::size_t size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(raster.cols);
    std::span<const float> values;
    if (raster.source) {
      buffer.resize(size);
      SCARP_RETURN_IF_ERROR(raster.source->read(0, row, raster.cols, rows, buffer.data(), raster.cols));
      values = buffer;
    } else {
      values = {raster.samples.data() + static_cast<std::ptrdiff_t>(row) * raster.cols, size};
    }
    for (std::size_t k = 0; k < size; ++k) {
      if (values[k] < 0) return refuse_negative(raster, values[k], row, k);
      if (!std::isnan(values[k])) largest = std::max(largest.value_or(0), values[k]);
    }
    SCARP_RETURN_IF_ERROR(look.report(raster, row));
  }
  return largest;
}

/// The weight for a raster value, given the largest one.
float weight_of_value(float value, float largest) {
  if (std::isnan(value)) return 0;
  return largest > 1 ? value / largest : value;
}

}  // namespace

Result<OwnedTolerances> make_tolerances(std::optional<OwnedHeightField> raster, std::span<const Region> regions,
                                        const RegionGrid& grid, const ToleranceOptions& options) {
  if (!raster && regions.empty())
    return fail(ErrorKind::kUsage, "tolerances are made of a raster or of regions, and there are none");
  if (raster && (raster->cols != grid.cols || raster->rows != grid.rows))
    return fail(ErrorKind::kUsage, fmt::format("{} is {} x {} samples instead of {} x {}", raster->info.path,
                                               raster->cols, raster->rows, grid.cols, grid.rows));
  if (raster && raster->source && !options.in_windows)
    return fail(ErrorKind::kUsage, raster->info.path + " is not in memory: ask for tolerances in windows");
  OwnedTolerances made;
  if (raster) {
    const ProgressCallback& progress = options.in_windows ? options.run.progress : ProgressCallback();
    SCARP_TRY(const auto& largest, look_through(*raster, progress));
    made.has_values = largest.has_value();
    if (!made.has_values && regions.empty() && !grid.beyond)
      return fail(ErrorKind::kInput, fmt::format("{}: none of its {} x {} samples has a value", raster->info.path,
                                                 raster->cols, raster->rows));
  }

  if (options.in_windows) {
    if (raster) {
      const bool is_rounded = raster->sample_rounding > 0;
      made.source = std::make_shared<RasterValues>(
          std::move(*raster), [is_rounded](float value) { return tolerance_of_value(value, is_rounded); });
    }
    if (regions.empty()) return made;
    RegionBounds bounds = make_region_bounds(regions, grid, options.run.threads);
    made.source = made.source ? std::make_shared<LeastTolerances>(std::move(bounds.source), std::move(made.source))
                              : std::move(bounds.source);
    made.found = std::move(bounds.found);
    made.bytes = bounds.bytes;
    return made;
  }
  if (raster) {
    const bool is_rounded = raster->sample_rounding > 0;
    made.values = std::move(raster->samples);
    for (float& value : made.values) value = tolerance_of_value(value, is_rounded);
  }
  if (regions.empty()) return made;
  std::vector<float> bounds = region_tolerances(regions, grid, &made.found);
  if (made.values.empty()) {
    made.values = std::move(bounds);
  } else {
    for (std::size_t k = 0; k < bounds.size(); ++k) made.values[k] = std::min(made.values[k], bounds[k]);
  }
  return made;
}

Result<OwnedWeights> make_weights(OwnedHeightField raster, const ToleranceOptions& options) {
  if (raster.source && !options.in_windows)
    return fail(ErrorKind::kUsage, raster.info.path + " is not in memory: ask for weights in windows");
  SCARP_TRY(const auto& found, look_through(raster, options.in_windows ? options.run.progress : ProgressCallback()));
  const float largest = found.value_or(0);
  if (largest == 0)
    return fail(ErrorKind::kInput,
                fmt::format("{}: no weight is above 0, so no sample would have a bound", raster.info.path));
  const auto meaning = [largest](float value) { return weight_of_value(value, largest); };
  OwnedWeights made;
  if (options.in_windows) {
    made.source = std::make_shared<RasterValues>(std::move(raster), meaning);
  } else {
    made.values = std::move(raster.samples);
    std::transform(made.values.begin(), made.values.end(), made.values.begin(), meaning);
  }
  return made;
}

}  // namespace scarp
