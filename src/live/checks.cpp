#include "live/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace scarp::live {

namespace {

constexpr std::int32_t kFarthest = 1 << 30;

bool is_far(std::int64_t place) { return place < -kFarthest || place > kFarthest; }

Result<void> check_tolerances(std::span<const float> tolerances) {
  const auto bad = std::find_if(tolerances.begin(), tolerances.end(), [](float bound) { return !(bound >= 0); });
  if (bad == tolerances.end()) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("tolerance {} (counted from 0) is {}: give 0 or more", bad - tolerances.begin(), *bad));
}

}  // namespace

Result<void> check_field(const HeightField& field, const LiveOptions& options, std::span<const float> tolerances) {
  const auto refuse = [](std::string why) { return fail(ErrorKind::kUsage, "a live field " + std::move(why)); };
  if (field.samples == nullptr || field.source != nullptr) return refuse("needs its samples in memory");
  const auto is_weight = [](double scale) { return scale >= 0 && std::isfinite(scale); };
  if (std::cmp_greater(field.channels.size(), kMaxChannels))
    return refuse(fmt::format("has at most {} channels, not {}", kMaxChannels, field.channels.size()));
  for (std::size_t k = 0; k < field.channels.size(); ++k) {
    const Channel& channel = field.channels[k];
    if (channel.samples == nullptr) return refuse(fmt::format("lacks the values of channel {}", k + 1));
    if (!is_weight(channel.scale))
      return refuse(fmt::format("needs weights of at least 0, not {} for channel {}", channel.scale, k + 1));
  }
  if (!is_weight(field.height_scale))
    return refuse(fmt::format("needs weights of at least 0, not {} for the heights", field.height_scale));
  if (field.height_scale == 0 &&
      std::all_of(field.channels.begin(), field.channels.end(), [](const Channel& c) { return c.scale == 0; }))
    return refuse("needs a weight above 0, for the heights or a channel");
  if (!field.frame.is_affine()) return refuse("needs an affine frame");
  if (field.cols < 2 || field.rows < 2)
    return refuse(fmt::format("needs 2 × 2 samples at least, not {} × {}", field.cols, field.rows));
  if (!(options.max_error >= 0) || !std::isfinite(options.max_error))
    return refuse(fmt::format("needs a finite max error of at least 0, not {}", options.max_error));
  if (!(field.sample_rounding >= 0) || !std::isfinite(field.sample_rounding))
    return refuse(fmt::format("needs a finite sample rounding of at least 0, not {}", field.sample_rounding));
  if (!options.max_triangles && field.sample_rounding > options.max_error)
    return refuse(fmt::format("needs a max error of at least {}, the rounding of its samples, not {}",
                              field.sample_rounding, options.max_error));
  if (options.effort != Effort::kFast && options.effort != Effort::kNormal && options.effort != Effort::kHigh)
    return refuse("has the efforts fast, normal and high; max takes seconds for a cell");
  if (options.max_triangles == 0) return refuse("needs a budget of at least 1 triangle");
  if (options.level && !options.max_triangles) return refuse("has a level only with a budget: omit the level");
  constexpr int kLeast = 8, kMost = 254;
  if (options.cell != 0 && (options.cell < kLeast || options.cell > kMost))
    return refuse(fmt::format("has cells of {} to {} samples, not {}", kLeast, kMost, options.cell));
  const std::size_t samples = std::size_t(field.cols) * std::size_t(field.rows);
  if (options.max_triangles && !tolerances.empty())
    return refuse("has a budget or tolerances: a budget moves the bounds of all samples");
  if (!tolerances.empty() && tolerances.size() != samples)
    return refuse(
        fmt::format("of {} samples cannot have {} tolerances: give one for each", samples, tolerances.size()));
  const auto reaches = [](std::int32_t place, int count) {
    return is_far(place) || is_far(std::int64_t{place} + count);
  };
  if (reaches(options.place.col, field.cols) || reaches(options.place.row, field.rows))
    return refuse("lies within 2^30 samples of the place 0, 0");
  const std::array<double, 6>& to = field.frame.affine;
  const double reach = std::abs(to[0]) + std::abs(to[3]) + (std::abs(to[1]) + std::abs(to[4])) * field.cols +
                       (std::abs(to[2]) + std::abs(to[5])) * field.rows;
  const double step = std::min(std::hypot(to[1], to[4]), std::hypot(to[2], to[5]));
  if (field.frame.determinant() == 0 || !(step > reach * std::numeric_limits<double>::epsilon()))
    return refuse("needs a frame whose samples lie apart in x and y: move it nearer to 0, or give larger cells");
  return check_tolerances(tolerances);
}

Result<void> check_window(const LiveWindow& window, const FieldSamples& samples, std::size_t heights,
                          std::span<const float> tolerances, std::span<const std::span<const float>> channels) {
  const auto refuse = [](std::string why) { return fail(ErrorKind::kUsage, std::move(why)); };
  const auto ends = [](int first, int count, int of) {
    return first >= 0 && count > 0 && std::int64_t{first} + count <= of;
  };
  const Area& field = samples.area();
  if (!ends(window.col, window.cols, field.cols()) || !ends(window.row, window.rows, field.rows()))
    return refuse(
        fmt::format("the window of {} columns and {} rows at column {}, row {} is not within the live field of "
                    "{} columns and {} rows",
                    window.cols, window.rows, window.col, window.row, field.cols(), field.rows()));
  const std::size_t count = std::size_t(window.cols) * std::size_t(window.rows);
  const std::string name =
      fmt::format("the window of {} columns and {} rows needs {}", window.cols, window.rows, count);
  if (heights != count) return refuse(fmt::format("{} heights, not {}", name, heights));
  if (!tolerances.empty() && !samples.has_tolerances())
    return refuse("the live field was made without tolerances: give some when it is made");
  if (!tolerances.empty() && tolerances.size() != count)
    return refuse(fmt::format("{} tolerances, or none, not {}", name, tolerances.size()));
  if (!channels.empty() && channels.size() != samples.channel_count())
    return refuse(fmt::format("the live field has {} channels: give a window values of all, or of none, not of {}",
                              samples.channel_count(), channels.size()));
  for (const std::span<const float> channel : channels) {
    if (channel.size() != count) return refuse(fmt::format("{} values of a channel, not {}", name, channel.size()));
  }
  return check_tolerances(tolerances);
}

Result<void> check_scroll(const Area& area, int cols, int rows) {
  for (const std::int64_t end : {std::int64_t{area.west} + cols, std::int64_t{area.east} + cols,
                                 std::int64_t{area.north} + rows, std::int64_t{area.south} + rows}) {
    if (is_far(end))
      return fail(ErrorKind::kUsage,
                  fmt::format("scrolled by {} columns and {} rows, the live field would lie beyond 2^30 samples from "
                              "the place 0, 0",
                              cols, rows));
  }
  return {};
}

}  // namespace scarp::live
