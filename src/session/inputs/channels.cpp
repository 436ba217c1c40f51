#include "session/inputs/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "io/commands.h"
#include "session/inputs/companions.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

Result<void> check_weight_count(const ChannelPlan& plan, std::size_t channels) {
  if (plan.weights.empty() || plan.weights.size() == channels) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} has {} for {}: give one a band", kChannelWeights,
                          format_plural(plan.weights.size(), "weight"), format_plural(channels, "band")));
}

/// Largest minus smallest value; 0 without values.
double range_of(const std::vector<float>& band) {
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  for (const float value : band) {
    if (!std::isfinite(value)) continue;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  return lowest <= highest ? static_cast<double>(highest) - static_cast<double>(lowest) : 0;
}

/// The channels' weights with a norm of 1, so that all channels together count once.
std::vector<double> normalize(std::vector<double> weights, Norm norm) {
  double length = 0;
  for (const double weight : weights) {
    if (norm == Norm::kSum) length += weight;
    if (norm == Norm::kSquares) length = std::hypot(length, weight);
    if (norm == Norm::kMax) length = std::max(length, weight);
  }
  for (double& weight : weights) weight /= length;
  return weights;
}

std::vector<double> weights_of(const ChannelPlan& plan, std::size_t channels) {
  return plan.weights.empty() ? std::vector<double>(channels, 1.0) : plan.weights;
}

std::vector<std::string> name_bands(const OwnedChannels& channels) {
  if (channels.is_color && channels.bands.size() == 3) return {"red", "green", "blue"};
  if (channels.bands.size() == 1) return {"grey"};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < channels.bands.size(); ++k) names.push_back(fmt::format("band {}", k + 1));
  return names;
}

void set_magnitude(Channels& channels) {
  for (std::size_t k = 0; k < channels.count(); ++k) {
    double largest = 0;
    for (const float value : channels.bands.bands[k]) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
    }
    channels.magnitude += channels.scales[k] * largest;
  }
}

/// Fails for a height without a texture value.
Result<void> check_coverage(const OwnedChannels& texture, const OwnedHeightField& heights) {
  for (std::size_t band = 0; band < texture.bands.size(); ++band) {
    const std::vector<float>& values = texture.bands[band];
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isfinite(values[k]) || !std::isfinite(heights.samples[k])) continue;
      const std::size_t cols = static_cast<std::size_t>(heights.cols);
      return fail(ErrorKind::kInput,
                  fmt::format("{} {}: band {} has no value at column {}, row {}, where {} has a height: fill it "
                              "first (gdal_fillnodata.py -b {} {} {})",
                              kTexture, texture.info.path, band + 1, k % cols, k / cols, heights.info.path, band + 1,
                              io::file_word(texture.info.path), io::new_file(".tif")));
    }
  }
  return {};
}

/// Appends the bands of `more` to those of `channels`.
void append(OwnedChannels& channels, OwnedChannels more) {
  if (channels.bands.empty()) {
    channels = std::move(more);
    return;
  }
  channels.is_color = false;
  channels.is_8bit = channels.is_8bit && more.is_8bit;
  std::move(more.bands.begin(), more.bands.end(), std::back_inserter(channels.bands));
  std::move(more.info.warnings.begin(), more.info.warnings.end(), std::back_inserter(channels.info.warnings));
}

}  // namespace

void Channels::attach_to(HeightField& field) const {
  field.channels.clear();
  for (std::size_t k = 0; k < count(); ++k) field.channels.push_back({bands.bands[k].data(), scales[k]});
  if (!empty()) field.height_scale = height_scale;
}

Result<Channels> read_textures(const ChannelPlan& plan, const OwnedHeightField& heights,
                               const ProgressCallback& progress) {
  Channels channels;
  for (const std::string& path : plan.textures) {
    ReadOptions options;
    options.crs = "grid";
    options.run.progress = progress;
    Result<OwnedChannels> texture = read_channels(path, options);
    if (!texture) {
      texture.error().message = fmt::format("{}: {}", kTexture, texture.error().message);
      return tl::unexpected(std::move(texture.error()));
    }
    SCARP_RETURN_IF_ERROR(check_grid(heights.info, heights.cols, heights.rows, name_of(kTexture).c_str(), texture->info,
                                     texture->cols, texture->rows));
    SCARP_RETURN_IF_ERROR(check_coverage(*texture, heights));
    append(channels.bands, std::move(*texture));
  }
  if (channels.count() > kMaxChannels) {
    return fail(ErrorKind::kInput, fmt::format("{}: the files hold {} bands, more than {}: leave some out", kTexture,
                                               channels.count(), kMaxChannels));
  }
  SCARP_RETURN_IF_ERROR(check_weight_count(plan, channels.count()));

  channels.names = name_bands(channels.bands);
  const double relief = heights.info.max > heights.info.min ? heights.info.max - heights.info.min : 1;
  const double w = plan.texture_weight;
  channels.height_scale = w < 1 ? 1 : 0;
  const double emphasis = w < 1 ? w / (1 - w) : 1;
  const std::vector<double> weights = normalize(weights_of(plan, channels.count()), plan.norm);
  for (std::size_t k = 0; k < channels.count(); ++k) {
    const double range = range_of(channels.bands.bands[k]);
    channels.scales.push_back(range > 0 ? emphasis * relief * weights[k] / range : 0);
  }
  set_magnitude(channels);
  return channels;
}

Result<Image> read_image(const ChannelPlan& plan, const std::string& path, const ReadOptions& options, bool one_band) {
  Image image;
  Channels& channels = image.channels;
  SCARP_TRY(channels.bands, read_channels(path, options, !one_band));
  SCARP_RETURN_IF_ERROR(check_weight_count(plan, channels.count()));

  channels.names = name_bands(channels.bands);
  channels.height_scale = 0;
  std::vector<double> ranges;
  for (const std::vector<float>& band : channels.bands.bands) ranges.push_back(range_of(band));
  const bool in_levels = channels.bands.is_8bit;
  channels.relief = in_levels ? 255 : *std::max_element(ranges.begin(), ranges.end());
  const std::vector<double> weights = weights_of(plan, channels.count());
  for (std::size_t k = 0; k < channels.count(); ++k) {
    const double share = in_levels ? 1 : ranges[k] > 0 ? channels.relief / ranges[k] : 0;
    channels.scales.push_back(weights[k] * share);
  }

  OwnedHeightField& field = image.field;
  field.cols = channels.bands.cols;
  field.rows = channels.bands.rows;
  field.frame = channels.bands.frame;
  field.info = channels.bands.info;
  field.samples.assign(channels.bands.bands.front().size(), 0);
  for (const std::vector<float>& band : channels.bands.bands) {
    for (std::size_t k = 0; k < band.size(); ++k) {
      if (!std::isfinite(band[k])) field.samples[k] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  if (height_range(field).valid == 0) {
    return fail(ErrorKind::kInput, fmt::format("{} has no sample with a value in every band", path));
  }
  set_magnitude(channels);
  return image;
}

}  // namespace scarp::cli
