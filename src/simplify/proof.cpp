#include "simplify/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/norm.h"
#include "base/parallel.h"
#include "grid/window.h"
#include "measure/band.h"

namespace scarp::run {

namespace {

/// The norm of all errors at each sample, collected field by field.
class Tally {
 public:
  Tally(const HeightField& field, Norm norm)
      : cols_(static_cast<std::size_t>(field.cols)),
        norm_(norm),
        totals_(cols_ * static_cast<std::size_t>(field.rows), 0) {}

  /// For MeasureOptions::on_row: adds scale · |error|.
  auto adder(double scale) {
    return [this, scale](int row, std::span<const float> errors) {
      float* totals = &totals_[static_cast<std::size_t>(row) * cols_];
      for (std::size_t x = 0; x < cols_; ++x) {
        const double error = scale * std::abs(double{errors[x]});
        totals[x] = std::isnan(error) ? NAN : static_cast<float>(add_to_norm_of(norm_, double{totals[x]}, error));
      }
    };
  }
  /// NaN where the sample is nodata or uncovered.
  std::span<const float> row(std::size_t y) const { return std::span(totals_).subspan(y * cols_, cols_); }

 private:
  std::size_t cols_;
  Norm norm_;
  std::vector<float> totals_;
};

/// The mesh with a channel's values as its heights.
Mesh raise_channel(const Mesh& mesh, int channel) {
  Mesh raised;
  raised.origin = {mesh.origin[0], mesh.origin[1], 0};
  raised.positions = mesh.positions;
  raised.triangles = mesh.triangles;
  const auto count = static_cast<std::size_t>(mesh.channel_count);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    raised.positions[3 * v + 2] = mesh.channels[count * v + static_cast<std::size_t>(channel)];
  return raised;
}

/// Measures each channel as if it were the height, over the same samples.
Result<void> measure_channels(const HeightField& field, const SimplifyOptions& options, Tally& tally,
                              Simplified& result) {
  const auto samples = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  std::vector<float> values(samples);
  result.channel_measurements.clear();
  for (std::size_t k = 0; k < field.channels.size(); ++k) {
    for (std::size_t i = 0; i < samples; ++i) {
      const float z = field.samples[i];
      const bool is_nodata = !std::isfinite(z) || (field.nodata && z == *field.nodata);
      values[i] = is_nodata ? NAN : field.channels[k].samples[i];
    }
    HeightField raised = field;
    raised.samples = values.data();
    raised.nodata = std::nullopt;
    raised.channels.clear();
    MeasureOptions judge;
    judge.topology = false;
    judge.run.threads = options.run.threads;
    judge.on_row = tally.adder(field.channels[k].scale);
    SCARP_TRY(auto&& measured, measure(raised, raise_channel(result.mesh, static_cast<int>(k)), judge));
    result.channel_measurements.push_back(std::move(measured));
  }
  return {};
}

/// No sample is farther from 0 than this plus the bound. In space, a position's z is no height.
double largest_height(const HeightField& field, const Mesh& mesh, const HeightRange& range) {
  double largest = 0;
  if (field.frame.space) return std::max(std::abs(range.min), std::abs(range.max));
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    largest = std::max(largest, std::abs(mesh.origin[2] + mesh.positions[3 * v + 2]));
  return largest;
}

/// Rounding of the judge's double arithmetic, relative to the largest height and the bound.
constexpr double kArithmetic = 1e-12;

/// The requested bounds of a row's samples; empty: no individual bounds.
struct AskedOfRow {
  std::span<const float> mask, tolerance, bounds;

  double weigh(std::size_t x, double error) const {
    if (!mask.empty()) return mask[x] * error;
    return error == 0 ? 0 : error / tolerance[x];
  }
  bool is_bounded(std::size_t x) const { return bounds.empty() || !std::isinf(bounds[x]); }
};

/// The error of a sample relative to its requested bound, before the search for a budget's mesh multiplied this bound.
struct ShareOfBound {
  double most = HUGE_VAL;  ///< in addition to the tolerance
  double reserve = 0;      ///< for the rounding of samples
  double noise = 0;        ///< error of the judge's own rounding

  double of(double error, float tolerance) const {
    const double asked = std::min(most, double{tolerance});
    if (asked > 0) return (error + reserve) / asked;
    return error <= noise ? 0 : HUGE_VAL;
  }
};

/// Collects norms of errors, row by row: weighted errors, the largest norm, the samples that break a bound. The rows'
/// errors and each step of their norm are rounded to float32, so an error within this rounding of a bound is doubtful.
/// It counts as a breach if mending is possible, else it does not.
class SampleVerdict {
 public:
  /// `fields`: number of fields in the norms.
  /// `largest`: see largest_height().
  SampleVerdict(const metric::Criterion& criterion, bool exact, std::size_t fields, double largest, Simplified& result,
                Proof& proof)
      : bound_(criterion.bound()),
        doubt_((exact ? 1 : -1) * 0x1p-24 * (3 + static_cast<double>(fields))),
        arithmetic_(exact ? kArithmetic * largest : 0),
        share_{criterion.most() / criterion.factor(), criterion.reserve(), arithmetic_},
        result_(result),
        proof_(proof) {
    result_.combined_max_error = result_.weighted_max_error = result_.judged_max_error = 0;
  }

  void add(int row, std::span<const float> norms, const AskedOfRow& asked) {
    const bool has_weights = !asked.mask.empty() || !asked.tolerance.empty();
    for (std::size_t x = 0; x < norms.size(); ++x) {
      const double error = norms[x];
      if (std::isnan(error)) continue;
      result_.combined_max_error = std::max(result_.combined_max_error, error);
      combined_squares_ += error * error;
      ++count_;
      if (has_weights) {
        const double value = asked.weigh(x, error);
        result_.weighted_max_error = std::max(result_.weighted_max_error, value);
        squares_ += value * value;
      }
      if (asked.is_bounded(x))
        judge(!asked.tolerance.empty() ? share_.of(error, asked.tolerance[x])
              : has_weights            ? asked.weigh(x, error)
                                       : error);
      if (result_.stop != StopReason::kMaxError) continue;
      const double bound = asked.bounds.empty() ? *bound_ : double{asked.bounds[x]};
      if (error <= bound + (doubt_ * error + arithmetic_)) continue;
      proof_.offenders.push_back({static_cast<std::int32_t>(x), row, error});
      if (proof_.broken.empty())
        proof_.broken =
            fmt::format("the bound {} cannot be kept: at sample ({}, {}) the mesh is off by {}", bound, x, row, error);
    }
  }

  void finish() {
    const auto samples = static_cast<double>(std::max<std::uint64_t>(count_, 1));
    result_.weighted_rmse = std::sqrt(squares_ / samples);
    result_.combined_rmse = std::sqrt(combined_squares_ / samples);
    result_.judged_rmse = std::sqrt(judged_squares_ / static_cast<double>(std::max<std::uint64_t>(judged_, 1)));
  }

 private:
  void judge(double value) {
    result_.judged_max_error = std::max(result_.judged_max_error, value);
    judged_squares_ += value * value;
    ++judged_;
  }

  std::optional<double> bound_;
  double doubt_, arithmetic_;
  ShareOfBound share_;
  Simplified& result_;
  Proof& proof_;
  double squares_ = 0, combined_squares_ = 0, judged_squares_ = 0;
  std::uint64_t count_ = 0, judged_ = 0;
};

void judge_samples(const SimplifyOptions& options, const metric::Criterion& criterion, const HeightField& field,
                   const Tally& tally, SampleVerdict& verdict) {
  const auto cols = static_cast<std::size_t>(field.cols);
  for (std::size_t y = 0; y < static_cast<std::size_t>(field.rows); ++y) {
    const auto of_row = [&](std::span<const float> all) { return all.empty() ? all : all.subspan(y * cols, cols); };
    verdict.add(static_cast<int>(y), tally.row(y),
                {of_row(options.tolerances.weights), of_row(options.tolerances.values), of_row(criterion.bounds())});
  }
  verdict.finish();
}

/// Judges each row by bounds that are read for some rows at a time.
class WindowedVerdict {
 public:
  WindowedVerdict(const HeightField& field, const metric::SourceBounds& bounds, SampleVerdict verdict)
      : field_(field),
        bounds_(bounds),
        verdict_(std::move(verdict)),
        promised_(static_cast<std::size_t>(field.cols)),
        norms_(promised_.size()) {}

  /// Number of samples whose tolerances or weights are held.
  static std::uint64_t most_held(const HeightField& field) {
    return static_cast<std::uint64_t>(field.cols) * static_cast<unsigned>(rows_at_once(field));
  }

  /// For MeasureOptions::on_row.
  void add(int row, std::span<const float> errors) {
    if (!status_ || !hold(row)) return;
    const auto values = std::span<const float>(held_).subspan(
        held_.empty() ? 0 : static_cast<std::size_t>(row - first_) * promised_.size(),
        held_.empty() ? 0 : promised_.size());
    bounds_.find_bounds(row, values, promised_);
    std::transform(errors.begin(), errors.end(), norms_.begin(), [](float error) { return std::abs(error); });
    AskedOfRow asked{{}, {}, promised_};
    (bounds_.has_weights() ? asked.mask : asked.tolerance) = values;
    verdict_.add(row, norms_, asked);
    count_ignored(row);
  }
  /// The number of valid samples without a bound. Fails if reading did.
  Result<std::uint64_t> finish() {
    SCARP_RETURN_IF_ERROR(status_);
    verdict_.finish();
    return ignored_;
  }

 private:
  static int rows_at_once(const HeightField& field) {
    constexpr int kSamples = 1 << 18;
    return std::clamp(kSamples / field.cols, 1, field.rows);
  }

  bool hold(int row) {
    if (row < end_ || !bounds_.has_values()) return true;
    const int count = std::min(rows_at_once(field_), field_.rows - row);
    held_.resize(static_cast<std::size_t>(count) * promised_.size());
    status_ = bounds_.read_values(row, count, field_.cols, held_.data());
    first_ = row;
    end_ = row + count;
    return status_.has_value();
  }

  /// Counts valid samples without a bound, also those outside the mesh.
  void count_ignored(int row) {
    bool is_in_doubt = false;
    std::uint64_t covered = 0;
    for (std::size_t x = 0; x < norms_.size(); ++x) {
      if (!std::isinf(promised_[x])) continue;
      is_in_doubt = is_in_doubt || std::isnan(norms_[x]);
      ++covered;
    }
    if (is_in_doubt) {
      status_ = grid::read_window(field_, 0, row, field_.cols, 1, norms_.data(), field_.cols);
      covered = 0;
      for (std::size_t x = 0; x < norms_.size(); ++x) covered += std::isinf(promised_[x]) && !std::isnan(norms_[x]);
    }
    ignored_ += covered;
  }

  const HeightField& field_;
  const metric::SourceBounds& bounds_;
  SampleVerdict verdict_;
  std::vector<float> held_, promised_, norms_;  // held_ has the rows [first_, end_)
  int first_ = 0, end_ = 0;
  std::uint64_t ignored_ = 0;
  Result<void> status_;
};

/// Bytes of the band that a thread judges.
std::uint64_t band_bytes(const pieces::Recipe& recipe) {
  constexpr std::uint64_t kPerSample = 16, kOfReports = 8;
  const int cols = recipe.field.cols;
  return (kPerSample + (recipe.has_source_bounds ? kOfReports : 0)) * static_cast<std::uint64_t>(cols) *
         static_cast<unsigned>(judge::Band::rows_per_band(cols));
}

/// The number of threads whose bands fit in memory.
int threads_within(const pieces::Recipe& recipe) {
  return recipe.memory.threads_within(band_bytes(recipe), thread_count(recipe.options.run.threads));
}

std::string describe_breach(const Measurement& m, const SimplifyOptions& options) {
  if (m.uncovered > 0) return fmt::format("{} valid samples are not covered by the mesh", m.uncovered);
  return fmt::format("a max error of {} cannot be kept: at sample ({}, {}) the mesh is off by {}",
                     options.goals.max_error.value_or(0), m.max_error_at[0], m.max_error_at[1], m.max_error);
}

/// The factor of the bounds; errors are judged as float32.
double factor_of(const Simplified& result, const metric::Criterion& criterion) {
  if (result.stop == StopReason::kMaxError) return criterion.factor();
  return std::max(1.0, result.judged_max_error * (1 + 0x1p-22));
}

}  // namespace

std::uint64_t proof_bytes(const pieces::Recipe& recipe) {
  const std::uint64_t held = recipe.has_source_bounds ? WindowedVerdict::most_held(recipe.field) : 0;
  return static_cast<std::uint64_t>(threads_within(recipe)) * band_bytes(recipe) + held * sizeof(float);
}

Result<Proof> prove(const pieces::Recipe& recipe, const metric::Criterion& criterion, bool exact, Look look,
                    Simplified& result) {
  const HeightField& field = recipe.field;
  const SimplifyOptions& options = recipe.options;
  const metric::SourceBounds* windowed = criterion.source_bounds();
  const bool is_tallied = !criterion.bounds().empty() || !field.channels.empty() || field.height_scale != 1;
  const bool by_sample = is_tallied || windowed != nullptr;
  MeasureOptions judge;
  judge.topology = !exact && look == Look::kAll;
  if (!options.features.cutline.rings.empty()) judge.cutline = &options.features.cutline;
  judge.run.threads = threads_within(recipe);
  judge.run.progress = options.run.progress;
  if (result.stop == StopReason::kMaxError) judge.collect_above = by_sample ? HUGE_VAL : *criterion.bound();
  Proof proof;
  std::optional<Tally> tally;
  std::optional<WindowedVerdict> rows;
  if (is_tallied) judge.on_row = tally.emplace(field, options.goals.norm).adder(field.height_scale);
  if (windowed != nullptr) {
    rows.emplace(field, *windowed,
                 SampleVerdict(criterion, exact, 1, largest_height(field, result.mesh, {}), result, proof));
    judge.on_row = [&rows](int row, std::span<const float> errors) { rows->add(row, errors); };
  }
  SCARP_TRY(result.measurement, measure(field, result.mesh, judge));
  const Measurement& m = result.measurement;

  proof.offenders.insert(proof.offenders.begin(), m.offenders.begin(), m.offenders.end());
  if (is_tallied) {
    SCARP_RETURN_IF_ERROR(measure_channels(field, options, *tally, result));
    SampleVerdict verdict(criterion, exact, 1 + result.channel_measurements.size(),
                          largest_height(field, result.mesh, m.heights), result, proof);
    judge_samples(options, criterion, field, *tally, verdict);
  }
  if (rows) {
    SCARP_TRY(result.ignored, rows->finish());
  }
  if (by_sample) {
    if (m.uncovered > 0 && result.stop == StopReason::kMaxError) proof.broken = describe_breach(m, options);
  } else {
    result.judged_max_error = m.max_error;
    result.judged_rmse = m.rmse;
    // The judge's own double arithmetic rounds: this independently checks the engine's exact proof.
    const bool is_promised = result.stop == StopReason::kMaxError;
    const double rounding =
        kArithmetic * (criterion.bound().value_or(0) + largest_height(field, result.mesh, m.heights));
    if (is_promised && (!(m.max_error <= *criterion.bound() + rounding) || m.uncovered > 0))
      proof.broken = describe_breach(m, options);
  }
  proof.kept = proof.broken.empty();
  if (metric::has_tolerances(options)) result.tolerance_factor = factor_of(result, criterion);
  return proof;
}

}  // namespace scarp::run
