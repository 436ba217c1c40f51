#include "grid/height_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scarp {

namespace {

constexpr std::size_t kEnds = HeightRange::kEnds;
using Ends = std::array<HeightCount, kEnds>;

/// Adds a height to those at one end, `sign` times which ascend.
void add_to(Ends& ends, double sign, const HeightCount& more) {
  for (std::size_t k = 0; k < kEnds; ++k) {
    HeightCount& here = ends[k];
    if (here.samples > 0 && here.height == more.height) {
      here.samples += more.samples;
      return;
    }
    if (here.samples > 0 && sign * here.height < sign * more.height) continue;
    std::move_backward(ends.begin() + static_cast<std::ptrdiff_t>(k), ends.end() - 1, ends.end());
    here = more;
    return;
  }
}

/// Whether all of `low` … `high` lies strictly within what is known of the ends.
bool is_between_ends(const HeightRange& range, double low, double high) {
  const HeightCount &last_low = range.lowest.back(), &last_high = range.highest.back();
  return last_low.samples > 0 && last_high.samples > 0 && low > last_low.height && high < last_high.height;
}

struct Extent {
  float least = std::numeric_limits<float>::infinity(), most = -std::numeric_limits<float>::infinity();
  std::uint64_t valid = 0;
};

/// Lanes, since one minimum would have to wait for the one before it. `nodata`: NaN for none.
Extent extent_of(std::span<const float> samples, float nodata) {
  constexpr std::size_t kLanes = 8;
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::array<float, kLanes> least, most;
  std::array<std::uint32_t, kLanes> valid{};
  least.fill(std::numeric_limits<float>::infinity());
  most.fill(-std::numeric_limits<float>::infinity());
  const auto look = [&](std::size_t lane, float z) {
    const bool is_height = std::abs(z) <= kLargest && z != nodata;
    least[lane] = is_height && z < least[lane] ? z : least[lane];
    most[lane] = is_height && z > most[lane] ? z : most[lane];
    valid[lane] += is_height ? 1 : 0;
  };
  const std::size_t whole = samples.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) look(lane, samples[i + lane]);
  }
  for (std::size_t i = whole; i < samples.size(); ++i) look(i - whole, samples[i]);
  Extent extent{*std::min_element(least.begin(), least.end()), *std::max_element(most.begin(), most.end())};
  for (const std::uint32_t count : valid) extent.valid += count;
  return extent;
}

}  // namespace

void HeightRange::add(const HeightRange& part) {
  if (part.valid == 0) return;
  min = valid == 0 ? part.min : std::min(min, part.min);
  max = valid == 0 ? part.max : std::max(max, part.max);
  valid += part.valid;
  for (const HeightCount& more : part.lowest) {
    if (more.samples > 0) add_to(lowest, 1, more);
  }
  for (const HeightCount& more : part.highest) {
    if (more.samples > 0) add_to(highest, -1, more);
  }
}

HeightRange range_of(std::span<const float> samples, std::optional<float> nodata) {
  constexpr std::size_t kBlock = 4096;
  const float none = nodata.value_or(std::numeric_limits<float>::quiet_NaN());
  HeightRange range;
  for (std::size_t first = 0; first < samples.size(); first += kBlock) {
    const auto block = samples.subspan(first, std::min(kBlock, samples.size() - first));
    const Extent extent = extent_of(block, none);
    if (extent.valid == 0) continue;
    range.min = range.valid == 0 ? extent.least : std::min(range.min, double{extent.least});
    range.max = range.valid == 0 ? extent.most : std::max(range.max, double{extent.most});
    range.valid += extent.valid;
    if (is_between_ends(range, extent.least, extent.most)) continue;
    for (std::size_t i = 0; i < block.size();) {
      const float z = block[i];
      const std::size_t begin = i;
      do ++i;
      while (i < block.size() && block[i] == z);
      if (!std::isfinite(z) || z == none || is_between_ends(range, z, z)) continue;
      add_to(range.lowest, 1, {z, i - begin});
      add_to(range.highest, -1, {z, i - begin});
    }
  }
  return range;
}

void set_range(const HeightRange& range, RasterInfo& info) {
  info.has_range = true;
  info.valid = range.valid;
  info.min = range.min;
  info.max = range.max;
  info.undeclared_nodata = find_undeclared_nodata(range);
}

HeightRange height_range(const HeightField& field) {
  if (field.samples == nullptr) return {};
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  return range_of({field.samples, count}, field.nodata);
}

}  // namespace scarp
