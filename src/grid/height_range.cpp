#include "grid/height_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"

namespace scarp {

namespace {

constexpr std::size_t kEnds = HeightRange::kEnds;
using Ends = std::array<HeightCount, kEnds>;

/// Adds a height to the sorted list of one end; `sign` is −1 for the upper end.
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

/// True if the interval `low` … `high` lies strictly between the known ends.
bool is_between_ends(const HeightRange& range, double low, double high) {
  const HeightCount &last_low = range.lowest.back(), &last_high = range.highest.back();
  return last_low.samples > 0 && last_high.samples > 0 && low > last_low.height && high < last_high.height;
}

struct Extent {
  float least = std::numeric_limits<float>::infinity(), most = -std::numeric_limits<float>::infinity();
  std::uint64_t valid = 0;
};

/// Branchless, for vectorisation. `nodata`: NaN for none.
Extent extent_of(std::span<const float> samples, float nodata) {
  constexpr std::size_t kLanes = 16;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, kLanes> least, most, last;
  std::array<std::uint32_t, kLanes> valid{};
  least.fill(kInfinity);
  most.fill(-kInfinity);
  last.fill(kInfinity);
  const auto look = [&](const float* lanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float z = lanes[k];
      const float low = ((z != nodata) & (z > -kInfinity)) ? z : kInfinity;
      const float high = ((z != nodata) & (z < kInfinity)) ? z : -kInfinity;
      least[k] = low < least[k] ? low : least[k];
      most[k] = high > most[k] ? high : most[k];
      valid[k] += ((z != nodata) & (z > -kInfinity) & (z < kInfinity)) ? 1 : 0;
    }
  };
  const std::size_t whole = samples.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) look(&samples[i]);
  std::copy(samples.begin() + static_cast<std::ptrdiff_t>(whole), samples.end(), last.begin());
  if (whole < samples.size()) look(last.data());
  Extent extent{*std::min_element(least.begin(), least.end()), *std::max_element(most.begin(), most.end())};
  for (const std::uint32_t count : valid) extent.valid += count;
  return extent;
}

/// True if all samples lie strictly between `low` and `high`, or are NaN. Branchless, for vectorisation.
template <std::size_t kCount>
bool are_between(const float* samples, float low, float high) {
  int beyond = 0;
  for (std::size_t i = 0; i < kCount; ++i) beyond |= int{samples[i] <= low} | int{samples[i] >= high};
  return beyond == 0;
}

/// Adds the samples that may belong to the ends. `nodata`: NaN for none.
void note_ends(HeightRange& range, std::span<const float> samples, float nodata) {
  constexpr std::size_t kTogether = 32;
  std::size_t i = 0;
  while (i < samples.size()) {
    const auto low = static_cast<float>(range.lowest.back().height),
               high = static_cast<float>(range.highest.back().height);
    const bool has_ends = range.lowest.back().samples > 0 && range.highest.back().samples > 0 && low < high;
    while (has_ends && i + kTogether <= samples.size() && are_between<kTogether>(&samples[i], low, high))
      i += kTogether;
    const std::size_t stop = std::min(samples.size(), i + kTogether);
    while (i < stop) {
      const float z = samples[i];
      const std::size_t begin = i;
      do ++i;
      while (i < samples.size() && samples[i] == z);
      if (!std::isfinite(z) || z == nodata || is_between_ends(range, z, z)) continue;
      add_to(range.lowest, 1, {z, i - begin});
      add_to(range.highest, -1, {z, i - begin});
    }
  }
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

HeightRange grid::range_of(std::span<const float> samples, std::optional<float> nodata) {
  constexpr std::size_t kBlock = 512;
  const float none = nodata.value_or(std::numeric_limits<float>::quiet_NaN());
  HeightRange range;
  const auto block_at = [&](std::size_t k) {
    return samples.subspan(k * kBlock, std::min(kBlock, samples.size() - k * kBlock));
  };
  std::vector<Extent> extents;
  std::size_t lowest = 0, highest = 0;
  for (std::size_t k = 0; k * kBlock < samples.size(); ++k) {
    extents.push_back(extent_of(block_at(k), none));
    range.valid += extents[k].valid;
    if (extents[k].least < extents[lowest].least) lowest = k;
    if (extents[k].most > extents[highest].most) highest = k;
  }
  if (range.valid == 0) return range;
  range.min = extents[lowest].least;
  range.max = extents[highest].most;
  const auto look = [&](std::size_t k) {
    if (extents[k].valid > 0 && !is_between_ends(range, extents[k].least, extents[k].most))
      note_ends(range, block_at(k), none);
  };
  // The blocks with the lowest and the highest sample are scanned first, so that most others need no scan.
  look(lowest);
  if (highest != lowest) look(highest);
  for (std::size_t k = 0; k < extents.size(); ++k) {
    if (k != lowest && k != highest) look(k);
  }
  return range;
}

void grid::add_samples(HeightRange& range, std::span<const float> samples, float least, float most,
                       std::uint64_t valid) {
  if (valid == 0) return;
  range.min = range.valid == 0 ? least : std::min(range.min, double{least});
  range.max = range.valid == 0 ? most : std::max(range.max, double{most});
  range.valid += valid;
  if (!is_between_ends(range, least, most)) note_ends(range, samples, std::numeric_limits<float>::quiet_NaN());
}

void grid::set_range(const HeightRange& range, RasterInfo& info) {
  info.has_range = true;
  info.valid = range.valid;
  info.min = range.min;
  info.max = range.max;
  info.undeclared_nodata =
      find_undeclared_nodata(range, info.z_scale * info.scale, info.z_scale * info.offset + info.z_offset);
}

HeightRange height_range(const HeightField& field, int threads) {
  constexpr std::size_t kTogether = std::size_t{1} << 20;
  if (field.samples == nullptr) return {};
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  std::vector<HeightRange> parts((count + kTogether - 1) / kTogether);
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    const std::size_t first = i * kTogether;
    parts[i] = grid::range_of({field.samples + first, std::min(kTogether, count - first)}, field.nodata);
  });
  HeightRange whole;
  for (const HeightRange& part : parts) whole.add(part);
  return whole;
}

}  // namespace scarp
