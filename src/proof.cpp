#include "proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "goals.h"
#include "measure/band.h"

namespace scarp {

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
        const double error = scale * std::abs(double{errors[x]}), total = double{totals[x]};
        const double sum = norm_ == Norm::kSquares ? std::sqrt(total * total + error * error)
                           : norm_ == Norm::kSum   ? total + error
                                                   : std::max(error, total);
        totals[x] = std::isnan(error) ? NAN : static_cast<float>(sum);
      }
    };
  }
  std::size_t size() const { return totals_.size(); }
  /// NaN where the sample is void or uncovered.
  double norm_at(std::size_t i) const { return double{totals_[i]}; }
  Offender offender(std::size_t i) const {
    return {static_cast<std::int32_t>(i % cols_), static_cast<std::int32_t>(i / cols_), norm_at(i)};
  }

 private:
  std::size_t cols_;
  Norm norm_;
  std::vector<float> totals_;
};

double weighted(const SimplifyOptions& options, std::size_t i, double error) {
  if (!options.mask.empty()) return options.mask[i] * error;
  return error == 0 ? 0 : error / options.tolerance[i];
}

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
      const bool is_void = !std::isfinite(z) || (field.nodata && z == *field.nodata);
      values[i] = is_void ? NAN : field.channels[k].samples[i];
    }
    HeightField raised = field;
    raised.samples = values.data();
    raised.nodata = std::nullopt;
    raised.channels.clear();
    MeasureOptions judge;
    judge.topology = false;
    judge.threads = options.threads;
    judge.on_row = tally.adder(field.channels[k].scale);
    auto measured = measure(raised, raise_channel(result.mesh, static_cast<int>(k)), judge);
    if (!measured) return tl::unexpected(measured.error());
    result.channel_measurements.push_back(std::move(*measured));
  }
  return {};
}

/// Samples are no farther from 0 than this and the bound.
double largest_height(const Mesh& mesh) {
  double largest = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    largest = std::max(largest, std::abs(mesh.origin[2] + mesh.positions[3 * v + 2]));
  return largest;
}

/// The judge's double arithmetic rounds by this share of the largest height and the bound.
constexpr double kArithmetic = 1e-12;

/// Sums up the tally: weighted errors, the largest norm, who breaks a bound. The rows' errors and each step of their
/// norm are rounded to float32, so what lies that near a bound is doubtful: where mending is possible it is taken for
/// broken, else for kept.
void judge_samples(const SimplifyOptions& options, const Criterion& criterion, bool exact, const Tally& tally,
                   Simplified& result, Proof& proof) {
  const double rounding = 0x1p-24 * (4 + static_cast<double>(result.channel_measurements.size()));
  const bool has_weights = !options.mask.empty() || !options.tolerance.empty();
  const double arithmetic = exact ? kArithmetic * largest_height(result.mesh) : 0;
  double squares = 0, combined_squares = 0;
  std::uint64_t count = 0;
  result.combined_max_error = result.weighted_max_error = 0;
  for (std::size_t i = 0; i < tally.size(); ++i) {
    const double error = tally.norm_at(i);
    if (std::isnan(error)) continue;
    result.combined_max_error = std::max(result.combined_max_error, error);
    combined_squares += error * error;
    ++count;
    if (has_weights) {
      const double value = weighted(options, i, error);
      result.weighted_max_error = std::max(result.weighted_max_error, value);
      squares += value * value;
    }
    if (result.stop != StopReason::kMaxError) continue;
    const double bound = criterion.bounds().empty() ? *criterion.bound() : double{criterion.bounds()[i]};
    const double doubt = rounding * (exact ? error : -error) + arithmetic;
    if (error <= bound + doubt) continue;
    proof.offenders.push_back(tally.offender(i));
    if (proof.broken.empty())
      proof.broken = fmt::format("the bound {} cannot be kept: at sample ({}, {}) the mesh is off by {}", bound,
                                 proof.offenders.back().col, proof.offenders.back().row, error);
  }
  const auto samples = static_cast<double>(std::max<std::uint64_t>(count, 1));
  result.weighted_rmse = std::sqrt(squares / samples);
  result.combined_rmse = std::sqrt(combined_squares / samples);
}

/// Of the band that a thread judges.
std::uint64_t band_bytes(const HeightField& field) {
  constexpr std::uint64_t kPerSample = 16;
  return kPerSample * static_cast<std::uint64_t>(field.cols) *
         static_cast<unsigned>(judge::Band::rows_per_band(field.cols));
}

/// As many as the memory holds bands at work.
int threads_within(const HeightField& field, const SimplifyOptions& options) {
  return memory_budget(field, options).threads_within(band_bytes(field), thread_count(options.threads));
}

std::string describe_breach(const Measurement& m, const SimplifyOptions& options) {
  if (m.uncovered > 0) return fmt::format("{} valid samples are not covered by the mesh", m.uncovered);
  return fmt::format("a max error of {} cannot be kept: at sample ({}, {}) the mesh is off by {}",
                     options.max_error.value_or(0), m.max_error_at[0], m.max_error_at[1], m.max_error);
}

}  // namespace

std::uint64_t proof_bytes(const HeightField& field, const SimplifyOptions& options) {
  return static_cast<std::uint64_t>(threads_within(field, options)) * band_bytes(field);
}

Result<Proof> prove(const HeightField& field, const SimplifyOptions& options, const Criterion& criterion, bool exact,
                    Simplified& result) {
  const bool by_sample = !criterion.bounds().empty() || !field.channels.empty() || field.height_scale != 1;
  MeasureOptions judge;
  judge.topology = !exact;
  if (!options.cutline.rings.empty()) judge.cutline = &options.cutline;
  judge.threads = threads_within(field, options);
  judge.progress = options.progress;
  if (result.stop == StopReason::kMaxError) judge.collect_above = by_sample ? HUGE_VAL : *criterion.bound();
  std::optional<Tally> tally;
  if (by_sample) judge.on_row = tally.emplace(field, options.norm).adder(field.height_scale);
  auto measured = measure(field, result.mesh, judge);
  if (!measured) return tl::unexpected(measured.error());
  result.measurement = std::move(*measured);
  const Measurement& m = result.measurement;

  Proof proof;
  proof.offenders = m.offenders;
  if (by_sample) {
    if (auto done = measure_channels(field, options, *tally, result); !done) return tl::unexpected(done.error());
    judge_samples(options, criterion, exact, *tally, result, proof);
    if (m.uncovered > 0 && result.stop == StopReason::kMaxError) proof.broken = describe_breach(m, options);
  } else if (result.stop == StopReason::kMaxError) {
    // The judge's own double arithmetic rounds: the exact proof is the engine's, this is the independent check of it.
    const double rounding = kArithmetic * (*criterion.bound() + largest_height(result.mesh));
    if (!(m.max_error <= *criterion.bound() + rounding) || m.uncovered > 0) proof.broken = describe_breach(m, options);
  }
  proof.kept = proof.broken.empty();
  return proof;
}

}  // namespace scarp
