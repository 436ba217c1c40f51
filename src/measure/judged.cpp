// Samples without a bound are found first. They get an infinite limit and the others limit 0, so that measure() reports
// the largest errors of the others. Then errors are weighed: row by row during judging if bounds are read in windows,
// otherwise all at the end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "grid/point_rows.h"
#include "measure/error_weigher.h"
#include "measure/judge.h"

namespace scarp::judge {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kNoBound = std::numeric_limits<float>::infinity();

std::size_t count_samples(const HeightField& field) {
  return static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
}

/// REQUIRES: samples in memory.
bool is_nodata(const HeightField& field, std::size_t sample) {
  const float z = field.samples[sample];
  return !std::isfinite(z) || (field.nodata && z == *field.nodata);
}

/// Limits: 0 for samples with a bound, +infinity without.
class BoundLimits final : public SampleSource {
 public:
  explicit BoundLimits(const JudgeOptions& options)
      : weights_(options.tolerances.weights_source),
        tolerances_(options.max_error ? nullptr : options.tolerances.source),
        ignored_(grid::PointRows(options.tolerances.ignored)) {}

  /// True if samples may be without a bound.
  bool has_any() const { return weights_ != nullptr || tolerances_ != nullptr || !ignored_.empty(); }
  const grid::PointRows& ignored() const { return ignored_; }

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    const SampleSource* values = weights_ != nullptr ? weights_ : tolerances_;
    const float none = weights_ != nullptr ? 0 : kNoBound;
    if (values != nullptr) {
      SCARP_RETURN_IF_ERROR(values->read(col, row, cols, rows, out, stride));
    }
    for (int y = 0; y < rows; ++y) {
      float* limits = out + y * stride;
      for (int x = 0; x < cols; ++x) limits[x] = values != nullptr && limits[x] == none ? kNoBound : 0;
      ignored_.visit(row + y, col, cols, [&](std::int32_t x) { limits[x - col] = kNoBound; });
    }
    return {};
  }
  bool is_in_memory() const override { return false; }

 private:
  const SampleSource* weights_;
  const SampleSource* tolerances_;
  grid::PointRows ignored_;
};

/// The valid samples without a bound.
struct Exceptions {
  std::vector<float> limits;            ///< +infinity for these samples, 0 for others; empty if none
  std::unique_ptr<BoundLimits> source;  ///< the same, read in windows; null if none
  std::uint64_t count = 0;
};

/// Counts the heights without a bound. Reads both sources once.
Result<std::uint64_t> count_unbounded(const HeightField& field, const BoundLimits& limits) {
  constexpr int kSamples = 1 << 18;
  const int together = std::clamp(kSamples / field.cols, 1, field.rows);
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<float> heights, limit;
  std::uint64_t count = 0;
  for (int row = 0; row < field.rows; row += together) {
    const int rows = std::min(together, field.rows - row);
    const std::size_t first = static_cast<std::size_t>(row) * cols, size = static_cast<std::size_t>(rows) * cols;
    limit.resize(size);
    SCARP_RETURN_IF_ERROR(limits.read(0, row, field.cols, rows, limit.data(), field.cols));
    if (field.source != nullptr) {
      heights.resize(size);
      SCARP_RETURN_IF_ERROR(field.source->read(0, row, field.cols, rows, heights.data(), field.cols));
    }
    for (std::size_t k = 0; k < size; ++k) {
      const bool is_height = field.source != nullptr ? std::isfinite(heights[k]) : !is_nodata(field, first + k);
      count += limit[k] > 0 && is_height;
    }
  }
  return count;
}

/// The same if samples or bounds are read in windows.
Result<Exceptions> find_windowed_exceptions(const HeightField& field, const JudgeOptions& options) {
  Exceptions found;
  auto limits = std::make_unique<BoundLimits>(options);
  if (!limits->has_any()) return found;
  if (options.weigh) {
    SCARP_TRY(const auto& count, count_unbounded(field, *limits));
    found.count = count;
    if (count == 0) return found;
  }
  found.source = std::move(limits);
  return found;
}

Result<Exceptions> find_exceptions(const HeightField& field, const JudgeOptions& options) {
  if (field.samples == nullptr || options.tolerances.source != nullptr || options.tolerances.weights_source != nullptr)
    return find_windowed_exceptions(field, options);
  Exceptions found;
  const Tolerances& asked = options.tolerances;
  if (asked.weights.empty() && asked.values.empty() && asked.ignored.empty()) return found;
  found.limits.resize(count_samples(field), 0);
  for (std::size_t k = 0; k < options.tolerances.weights.size(); ++k) {
    if (options.tolerances.weights[k] == 0) found.limits[k] = kNoBound;
  }
  for (std::size_t k = 0; k < options.tolerances.values.size() && !options.max_error; ++k) {
    if (std::isinf(options.tolerances.values[k])) found.limits[k] = kNoBound;
  }
  for (const auto& [col, row] : asked.ignored)
    found.limits[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(col)] =
        kNoBound;
  for (std::size_t k = 0; k < found.limits.size(); ++k) found.count += found.limits[k] > 0 && !is_nodata(field, k);
  if (found.count == 0) found.limits.clear();
  return found;
}

/// The largest error of a covered sample; ties by the lowest row, then column.
LargestError find_largest(const std::vector<Offender>& offenders) {
  LargestError largest;
  for (const Offender& offender : offenders) {
    const double error = std::abs(offender.error);
    if (std::isinf(error) || error < largest.value) continue;
    const bool is_earlier = std::pair(offender.row, offender.col) < std::pair(largest.at[1], largest.at[0]);
    if (error > largest.value || is_earlier) largest = {error, {offender.col, offender.row}};
  }
  return largest;
}

/// Adds |scaled error| to each sample's norm; for kSquares, norms are sums of squares until the last error. Missing
/// errors are skipped.
void add_to_norms(std::span<double> norms, std::span<const float> errors, double scale, Norm norm) {
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (std::isnan(errors[k])) continue;
    const double error = scale * std::abs(static_cast<double>(errors[k]));
    if (norm == Norm::kSum) norms[k] += error;
    if (norm == Norm::kSquares) norms[k] += error * error;
    if (norm == Norm::kMax) norms[k] = std::max(norms[k], error);
  }
}

/// Judges one channel as a height, with nodata where the height is nodata.
class ChannelJudge {
 public:
  ChannelJudge(const HeightField& heights, const Mesh& mesh) : heights_(heights), mesh_(mesh) {
    shape_.origin = {mesh.origin[0], mesh.origin[1], 0};
    shape_.positions = mesh.positions;
    shape_.triangles = mesh.triangles;
  }

  Result<Measurement> judge(std::size_t channel, const MeasureOptions& options) {
    const float* band = heights_.channels[channel].samples;
    samples_.assign(band, band + count_samples(heights_));
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (is_nodata(heights_, k)) samples_[k] = kNaN;
    }
    const auto count = static_cast<std::size_t>(mesh_.channel_count);
    for (std::size_t v = 0; v < shape_.vertex_count(); ++v) {
      shape_.positions[3 * v + 2] = static_cast<double>(mesh_.channels[count * v + channel]);
    }
    const HeightField field{samples_.data(), heights_.cols, heights_.rows, std::nullopt, heights_.frame, 0, {}, 1};
    return measure(field, shape_, options);
  }

 private:
  const HeightField& heights_;
  const Mesh& mesh_;
  Mesh shape_;
  std::vector<float> samples_;
};

/// Bound of the rounding of the judge's arithmetic.
double rounding_of(const HeightRange& range, double magnitude) {
  return 1e-12 * (std::max(std::abs(range.min), std::abs(range.max)) + magnitude);
}

/// Upper bound of the norm of the scaled channel values.
double magnitude_of(const HeightField& field) {
  double magnitude = 0;
  for (const Channel& channel : field.channels) {
    double largest = 0;
    for (std::size_t k = 0; k < count_samples(field); ++k) {
      if (std::isfinite(channel.samples[k])) largest = std::max(largest, std::abs(double{channel.samples[k]}));
    }
    magnitude += channel.scale * largest;
  }
  return magnitude;
}

/// Weighs rows during judging, by tolerances or weights read in parallel.
class RowWeigher {
 public:
  /// REQUIRES: a source of tolerances or weights.
  RowWeigher(const HeightField& heights, const JudgeOptions& request, const Exceptions& exceptions, double allowance)
      : cols_(heights.cols),
        rows_(heights.rows),
        is_mask_(request.tolerances.weights_source != nullptr),
        values_(is_mask_ ? *request.tolerances.weights_source : *request.tolerances.source),
        ignored_(exceptions.source ? &exceptions.source->ignored() : nullptr),
        weigher_(is_mask_ ? request.max_error.value_or(HUGE_VAL) : 1, heights.sample_rounding, allowance) {}

  void add(int row, std::span<const float> errors) {
    if (!read_) return;
    const auto size = static_cast<std::size_t>(cols_);
    if (row >= end_) {
      constexpr int kSamples = 1 << 18;
      const int count = std::min(std::max(1, kSamples / cols_), rows_ - row);
      held_.resize(static_cast<std::size_t>(count) * size);
      read_ = values_.read(0, row, cols_, count, held_.data(), cols_);
      if (!read_) return;
      first_ = row;
      end_ = row + count;
    }
    const auto values = std::span<const float>(held_).subspan(static_cast<std::size_t>(row - first_) * size, size);
    ErrorWeigher::Row weighed{.errors = errors};
    (is_mask_ ? weighed.mask : weighed.tolerance) = values;
    if (ignored_ != nullptr && !ignored_->empty()) {
      limits_.assign(size, 0);
      ignored_->visit(row, 0, cols_, [&](std::int32_t x) { limits_[static_cast<std::size_t>(x)] = kNoBound; });
      weighed.limits = limits_;
    }
    weigher_.add(row, weighed);
  }
  Result<WeighedErrors> finish() const {
    SCARP_RETURN_IF_ERROR(read_);
    return weigher_.finish();
  }

 private:
  int cols_, rows_;
  bool is_mask_;
  const SampleSource& values_;
  const grid::PointRows* ignored_;
  ErrorWeigher weigher_;
  std::vector<float> held_, limits_;  // held_: values of rows [first_, end_); limits_: of a row
  int first_ = 0, end_ = 0;
  Result<void> read_;
};

/// Measures and weighs in one pass. Fails if a source fails.
Result<Measurement> measure_and_weigh(const HeightField& heights, const Mesh& mesh, RowWeigher rows,
                                      MeasureOptions options, std::optional<WeighedErrors>& weighed) {
  options.on_row = [&, keep = options.on_row](int row, std::span<const float> errors) {
    if (keep) keep(row, errors);
    rows.add(row, errors);
  };
  SCARP_TRY(Measurement measured, measure(heights, mesh, options));
  SCARP_TRY(weighed, rows.finish());
  return measured;
}

Result<void> check_request(const HeightField& field, const Mesh& mesh, const JudgeOptions& options) {
  const std::size_t samples = count_samples(field);
  for (const auto& [values, name] :
       {std::pair{options.tolerances.weights, "mask"}, std::pair{options.tolerances.values, "tolerance"}}) {
    if (!values.empty() && values.size() != samples)
      return fail(ErrorKind::kUsage, fmt::format("a {} of {} values for {} samples", name, values.size(), samples));
  }
  const int bounds = !options.tolerances.weights.empty() + (options.tolerances.weights_source != nullptr) +
                     !options.tolerances.values.empty() + (options.tolerances.source != nullptr);
  if (bounds > 1) return fail(ErrorKind::kUsage, "a mask and tolerances, or one of them twice: give one of them");
  if (options.max_error && !(*options.max_error >= 0))
    return fail(ErrorKind::kUsage, fmt::format("a max error of {}: it must be at least 0", *options.max_error));
  const bool needs_samples =
      !field.channels.empty() || !options.tolerances.weights.empty() || !options.tolerances.values.empty();
  if (field.samples == nullptr && needs_samples)
    return fail(
        ErrorKind::kUsage,
        "channels and arrays of weights or tolerances go with samples in memory: read the raster as a whole, or "
        "give weights and tolerances a source");
  if (!field.channels.empty() && field.frame.space)
    return fail(ErrorKind::kUsage, "channels beside a frame in space: an error in space is of heights alone");
  if (!field.channels.empty() && field.channels.size() != static_cast<std::size_t>(mesh.channel_count))
    return fail(ErrorKind::kUsage,
                fmt::format("the mesh has {} channels, the field {}", mesh.channel_count, field.channels.size()));
  for (const auto& [col, row] : options.tolerances.ignored) {
    if (col < 0 || row < 0 || col >= field.cols || row >= field.rows)
      return fail(ErrorKind::kUsage,
                  fmt::format("column {}, row {}, a sample that is ignored, lies outside the raster", col, row));
  }
  return {};
}

/// Weighs errors that were stored.
class Scales {
 public:
  Scales(const HeightField& field, const Judgement& judgement, const Exceptions& exceptions)
      : field_(field),
        judgement_(judgement),
        exceptions_(exceptions),
        reserve_(field.sample_rounding * (field.channels.empty() ? 1 : field.height_scale)),
        allowance_(rounding_of(judgement.heights.heights, magnitude_of(field))) {}

  WeighedErrors weigh(std::span<const float> mask, std::span<const float> tolerance, double bound) const {
    ErrorWeigher weigher(bound, reserve_, allowance_);
    const auto cols = static_cast<std::size_t>(field_.cols);
    for (int row = 0; row < field_.rows; ++row) {
      const auto row_of = [&](auto values) {
        return values.empty() ? values : values.subspan(static_cast<std::size_t>(row) * cols, cols);
      };
      weigher.add(row, {row_of(std::span(judgement_.height_errors)), row_of(std::span(judgement_.norms)), row_of(mask),
                        row_of(tolerance), row_of(std::span(exceptions_.limits))});
    }
    return weigher.finish();
  }

 private:
  const HeightField& field_;
  const Judgement& judgement_;
  const Exceptions& exceptions_;
  double reserve_, allowance_;
};

}  // namespace

double judging_allowance(double bound, const HeightRange& heights) {
  return 1e-12 * bound + 1e-12 * std::max(std::abs(heights.min), std::abs(heights.max));
}

Result<Judgement> judge_mesh(const HeightField& field, const Mesh& mesh, const JudgeOptions& request) {
  SCARP_RETURN_IF_ERROR(check_request(field, mesh, request));
  SCARP_TRY(const auto& exceptions, find_exceptions(field, request));
  const bool has_channels = !field.channels.empty();
  const bool weighs_later =
      request.weigh && (has_channels || !request.tolerances.weights.empty() || !request.tolerances.values.empty());
  const bool weighs_along =
      request.weigh && (request.tolerances.source != nullptr || request.tolerances.weights_source != nullptr);
  const bool keeps = request.keep_errors || weighs_later;
  const auto cols = static_cast<std::size_t>(field.cols);
  Judgement judgement;
  judgement.ignored = exceptions.count;
  if (keeps) judgement.height_errors.resize(count_samples(field), kNaN);
  if (keeps && has_channels) judgement.norms.resize(count_samples(field), 0);

  MeasureOptions options;
  options.run.threads = request.run.threads;
  options.run.progress = request.run.progress;
  options.topology = request.topology;
  options.cutline = request.cutline;
  options.tolerance = exceptions.limits;
  options.tolerance_source = exceptions.source.get();
  const bool has_exceptions = !options.tolerance.empty() || options.tolerance_source != nullptr;
  const auto keep_errors = [&](int row, std::span<const float> errors) {
    if (request.on_row) request.on_row(row, errors);
    if (!keeps) return;
    const std::size_t start = static_cast<std::size_t>(row) * cols;
    std::copy(errors.begin(), errors.end(), judgement.height_errors.begin() + static_cast<std::ptrdiff_t>(start));
    if (judgement.norms.empty()) return;
    add_to_norms(std::span(judgement.norms).subspan(start, cols), errors, field.height_scale, request.norm);
  };
  if (keeps || request.on_row) options.on_row = keep_errors;
  Result<Measurement> measured =
      weighs_along
          ? measure_and_weigh(field, mesh, RowWeigher(field, request, exceptions, 0), options, judgement.weighted)
          : measure(field, mesh, options);
  SCARP_RETURN_IF_ERROR(measured);
  judgement.heights = std::move(*measured);
  const std::vector<Offender> offenders = std::exchange(judgement.heights.offenders, {});
  judgement.heights.over_tolerance = 0;
  judgement.bounded = has_exceptions ? find_largest(offenders)
                                     : LargestError{judgement.heights.max_error, judgement.heights.max_error_at};

  options.topology = false;
  options.tolerance = {};
  options.tolerance_source = nullptr;
  options.on_row = {};
  if (judgement.weighted && judgement.weighted->over > 0) {
    const RowWeigher rows(field, request, exceptions, rounding_of(judgement.heights.heights, 0));
    SCARP_RETURN_IF_ERROR(measure_and_weigh(field, mesh, rows, options, judgement.weighted));
  }
  ChannelJudge channel_judge(field, mesh);
  for (std::size_t k = 0; k < field.channels.size(); ++k) {
    options.on_row = [&, k](int row, std::span<const float> errors) {
      if (judgement.norms.empty()) return;
      const std::size_t start = static_cast<std::size_t>(row) * cols;
      add_to_norms(std::span(judgement.norms).subspan(start, cols), errors, field.channels[k].scale, request.norm);
    };
    measured = channel_judge.judge(k, options);
    SCARP_RETURN_IF_ERROR(measured);
    judgement.channels.push_back(std::move(*measured));
  }
  if (request.norm == Norm::kSquares) {
    for (double& value : judgement.norms) value = std::sqrt(value);
  }
  if (!weighs_later) return judgement;

  const Scales scales(field, judgement, exceptions);
  const double bound = request.max_error.value_or(HUGE_VAL);
  if (has_channels) judgement.combined = scales.weigh({}, {}, bound);
  if (!request.tolerances.weights.empty()) judgement.weighted = scales.weigh(request.tolerances.weights, {}, bound);
  if (!request.tolerances.values.empty()) judgement.weighted = scales.weigh({}, request.tolerances.values, 1);
  if (!request.keep_errors) judgement.height_errors = {}, judgement.norms = {};
  return judgement;
}

std::vector<float> take_error_raster(Judgement judgement, ErrorsOf of) {
  std::vector<float> errors = std::move(judgement.height_errors);
  if (of == ErrorsOf::kHeights) return errors;
  for (std::size_t k = 0; k < judgement.norms.size(); ++k) {
    if (!std::isnan(errors[k])) errors[k] = static_cast<float>(judgement.norms[k]);
  }
  return errors;
}

}  // namespace scarp::judge
