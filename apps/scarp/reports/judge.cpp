#include "reports/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "terminal/text.h"

namespace scarp::cli {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// The largest error of a covered sample; the lowest row, then column, among equals.
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

/// Adds |scaled error| to each sample's norm: squares until they are all in. A missing error adds nothing.
void add_to_norms(std::span<double> norms, std::span<const float> errors, double scale, Norm norm) {
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (std::isnan(errors[k])) continue;
    const double error = scale * std::abs(static_cast<double>(errors[k]));
    if (norm == Norm::kSum) norms[k] += error;
    if (norm == Norm::kSquares) norms[k] += error * error;
    if (norm == Norm::kMax) norms[k] = std::max(norms[k], error);
  }
}

/// Judges one channel as a height: void where the height is.
class ChannelJudge {
 public:
  ChannelJudge(const HeightField& heights, const Mesh& mesh) : heights_(heights), mesh_(mesh) {
    shape_.origin = {mesh.origin[0], mesh.origin[1], 0};
    shape_.positions = mesh.positions;
    shape_.triangles = mesh.triangles;
  }

  Result<Measurement> judge(const std::vector<float>& band, std::size_t channel, const MeasureOptions& options) {
    samples_ = band;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (!std::isfinite(heights_.samples[k])) samples_[k] = kNaN;
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

/// What the judge's own arithmetic may have rounded.
double rounding_of(const HeightRange& range, double magnitude) {
  return 1e-12 * (std::max(std::abs(range.min), std::abs(range.max)) + magnitude);
}

/// Weighs rows as they are judged, by tolerances that are read along with them.
class RowWeigher {
 public:
  RowWeigher(const HeightField& heights, const SampleSource& tolerances, double allowance)
      : cols_(heights.cols),
        rows_(heights.rows),
        tolerances_(tolerances),
        weigher_(1, heights.sample_rounding, allowance) {}

  void add(int row, std::span<const float> errors) {
    if (!read_) return;
    const auto size = static_cast<std::size_t>(cols_);
    if (row >= end_) {
      constexpr int kSamples = 1 << 18;
      const int count = std::min(std::max(1, kSamples / cols_), rows_ - row);
      held_.resize(static_cast<std::size_t>(count) * size);
      read_ = tolerances_.read(0, row, cols_, count, held_.data(), cols_);
      if (!read_) return;
      first_ = row;
      end_ = row + count;
    }
    const std::size_t at = static_cast<std::size_t>(row - first_) * size;
    weigher_.add(row, {.errors = errors, .tolerance = std::span<const float>(held_).subspan(at, size)});
  }
  Result<WeighedErrors> finish() const {
    if (!read_) return tl::unexpected(read_.error());
    return weigher_.finish();
  }

 private:
  int cols_, rows_;
  const SampleSource& tolerances_;
  ErrorWeigher weigher_;
  std::vector<float> held_;  // rows [first_, end_)
  int first_ = 0, end_ = 0;
  Result<void> read_;
};

/// Measures and weighs in one. Fails as the sources do.
Result<Measurement> weigh_rows(const HeightField& heights, const Mesh& mesh, const SampleSource& tolerances,
                               double allowance, MeasureOptions options, std::optional<WeighedErrors>& weighed) {
  RowWeigher rows(heights, tolerances, allowance);
  options.on_row = [&](int row, std::span<const float> errors) { rows.add(row, errors); };
  Result<Measurement> measured = measure(heights, mesh, options);
  if (!measured) return measured;
  Result<WeighedErrors> found = rows.finish();
  if (!found) return tl::unexpected(std::move(found.error()));
  weighed = *found;
  return measured;
}

}  // namespace

Result<Judgement> judge(const HeightField& heights, const Mesh& mesh, const Channels& channels, Norm norm,
                        const JudgeOptions& request) {
  Judgement judgement;
  const std::size_t cols = static_cast<std::size_t>(heights.cols);
  const std::size_t samples = cols * static_cast<std::size_t>(heights.rows);
  if (request.keep_errors) judgement.height_errors.resize(samples, kNaN);
  if (request.keep_errors && !channels.empty()) judgement.norms.resize(samples, 0);

  MeasureOptions options;
  options.threads = request.threads;
  options.progress = request.progress;
  options.topology = request.topology;
  options.cutline = request.cutline;
  if (request.exceptions) {
    options.tolerance = request.exceptions->limits;
    options.tolerance_source = request.exceptions->source.get();
  }
  const bool has_exceptions = !options.tolerance.empty() || options.tolerance_source != nullptr;
  const auto keep_errors = [&](int row, std::span<const float> errors) {
    const std::size_t start = static_cast<std::size_t>(row) * cols;
    std::copy(errors.begin(), errors.end(), judgement.height_errors.begin() + static_cast<std::ptrdiff_t>(start));
    if (judgement.norms.empty()) return;
    add_to_norms(std::span(judgement.norms).subspan(start, cols), errors, channels.height_scale, norm);
  };
  if (request.keep_errors) options.on_row = keep_errors;
  Result<Measurement> measured = request.weigh_by == nullptr
                                     ? measure(heights, mesh, options)
                                     : weigh_rows(heights, mesh, *request.weigh_by, 0, options, judgement.weighed);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  judgement.heights = std::move(*measured);
  if (judgement.heights.uncovered > 0) {
    const auto& at = judgement.heights.uncovered_at;
    judgement.uncovered_sample = fmt::format("the first at column {}, row {}", at[0], at[1]);
  }
  judgement.bounded = has_exceptions ? find_largest(std::exchange(judgement.heights.offenders, {}))
                                     : LargestError{judgement.heights.max_error, judgement.heights.max_error_at};

  options.topology = false;
  options.tolerance = {};
  options.tolerance_source = nullptr;
  if (judgement.weighed && judgement.weighed->over > 0) {
    const auto again = weigh_rows(heights, mesh, *request.weigh_by, rounding_of(judgement.heights.heights, 0), options,
                                  judgement.weighed);
    if (!again) return tl::unexpected(again.error());
  }
  ChannelJudge channel_judge(heights, mesh);
  for (std::size_t k = 0; k < channels.count(); ++k) {
    options.on_row = [&, k](int row, std::span<const float> errors) {
      if (judgement.norms.empty()) return;
      const std::size_t start = static_cast<std::size_t>(row) * cols;
      add_to_norms(std::span(judgement.norms).subspan(start, cols), errors, channels.scales[k], norm);
    };
    measured = channel_judge.judge(channels.bands.bands[k], k, options);
    if (!measured) return tl::unexpected(std::move(measured.error()));
    judgement.channels.push_back(std::move(*measured));
  }
  if (norm == Norm::kSquares) {
    for (double& value : judgement.norms) value = std::sqrt(value);
  }
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

Result<void> restore_channels(Mesh& mesh, const Channels& channels, const std::string& path) {
  const std::size_t bands = channels.count();
  if (mesh.channel_count > 0 && static_cast<std::size_t>(mesh.channel_count) == bands) return {};
  if (mesh.channel_count == 0 && channels.are_colors() && !mesh.colors.empty()) {
    mesh.channel_count = static_cast<int>(bands);
    mesh.channels.reserve(bands * mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      for (std::size_t k = 0; k < bands; ++k) mesh.channels.push_back(mesh.colors[3 * v + k]);
    }
    return {};
  }
  if (mesh.channel_count == 0) {
    return fail(ErrorKind::kInput,
                fmt::format("{} holds {} to compare with {}: write it as .glb or .ply, of the same image", path,
                            mesh.colors.empty() ? "no colours" : "8-bit colours only", format_plural(bands, "band")));
  }
  return fail(ErrorKind::kInput,
              fmt::format("{} has {} but {} to compare with: give the files it was made from, in the same order", path,
                          format_plural(static_cast<std::uint64_t>(mesh.channel_count), "channel"),
                          format_plural(bands, "band")));
}

WeighedErrors weigh_errors(const Judgement& judgement, const HeightField& heights, const Channels& channels,
                           const Companions& companions, const Exceptions& exceptions, double bound) {
  ErrorWeigher weigher(bound, heights.sample_rounding * (channels.empty() ? 1 : channels.height_scale),
                       rounding_of(height_range(heights), channels.magnitude));
  const auto cols = static_cast<std::size_t>(heights.cols);
  for (int row = 0; row < heights.rows; ++row) {
    const auto row_of = [&](const auto& values) {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      return values.empty() ? std::span<const Value>()
                            : std::span<const Value>(values).subspan(static_cast<std::size_t>(row) * cols, cols);
    };
    weigher.add(row, {row_of(judgement.height_errors), row_of(judgement.norms), row_of(companions.mask),
                      row_of(companions.tolerance), row_of(exceptions.limits)});
  }
  return weigher.finish();
}

}  // namespace scarp::cli
