#include "judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "text.h"

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
  if (request.exceptions) options.tolerance = request.exceptions->limits;
  const auto keep_errors = [&](int row, std::span<const float> errors) {
    const std::size_t start = static_cast<std::size_t>(row) * cols;
    std::copy(errors.begin(), errors.end(), judgement.height_errors.begin() + static_cast<std::ptrdiff_t>(start));
    if (judgement.norms.empty()) return;
    add_to_norms(std::span(judgement.norms).subspan(start, cols), errors, channels.height_scale, norm);
  };
  if (request.keep_errors) options.on_row = keep_errors;
  Result<Measurement> measured = measure(heights, mesh, options);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  judgement.heights = std::move(*measured);
  if (judgement.heights.uncovered > 0) {
    const auto& at = judgement.heights.uncovered_at;
    judgement.uncovered_sample = fmt::format("the first at column {}, row {}", at[0], at[1]);
  }
  judgement.bounded = options.tolerance.empty()
                          ? LargestError{judgement.heights.max_error, judgement.heights.max_error_at}
                          : find_largest(std::exchange(judgement.heights.offenders, {}));

  options.topology = false;
  options.tolerance = {};
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
  WeighedErrors weighed;
  const double reserve = heights.sample_rounding * (channels.empty() ? 1 : channels.height_scale);
  const HeightRange range = height_range(heights);
  const double allowance = 1e-12 * (std::max(std::abs(range.min), std::abs(range.max)) + channels.magnitude);
  const double limit = bound * (1 + std::ldexp(1.0, -23));
  double sum_of_squares = 0;
  std::uint64_t judged = 0;
  for (std::size_t k = 0; k < judgement.height_errors.size(); ++k) {
    if (std::isnan(judgement.height_errors[k])) continue;
    ++judged;
    const double error =
        judgement.norms.empty() ? std::abs(static_cast<double>(judgement.height_errors[k])) : judgement.norms[k];
    const double value = companions.weigh(k, error);
    sum_of_squares += value * value;
    const LargestError here{value,
                            {static_cast<std::int32_t>(k % static_cast<std::size_t>(heights.cols)),
                             static_cast<std::int32_t>(k / static_cast<std::size_t>(heights.cols))}};
    if (value > weighed.largest.value) weighed.largest = here;
    if (exceptions.has(k)) continue;
    if (value > weighed.bounded.value) weighed.bounded = here;
    if (companions.weigh(k, std::max(0.0, error + reserve - allowance)) > limit) ++weighed.over;
  }
  if (judged > 0) weighed.rmse = std::sqrt(sum_of_squares / static_cast<double>(judged));
  return weighed;
}

}  // namespace scarp::cli
