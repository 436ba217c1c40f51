#include "live/field_samples.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace scarp::live {

namespace {

std::size_t count_of(const Area& area) { return std::size_t(area.cols()) * std::size_t(area.rows()); }

bool is_same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

FieldSamples::FieldSamples(const Area& area, bool has_tolerances, std::size_t channels)
    : area_(area), has_tolerances_(has_tolerances) {
  rings_.emplace_back(area.cols(), area.rows(), std::numeric_limits<float>::quiet_NaN());
  if (has_tolerances) rings_.emplace_back(area.cols(), area.rows(), std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < channels; ++k) rings_.emplace_back(area.cols(), area.rows(), 0.0f);
}

Patch FieldSamples::read(const Area& area) const {
  Patch patch{area, {}};
  for (const SampleRing& ring : rings_) ring.read(area, area_, patch.layers.emplace_back(count_of(area)).data());
  return patch;
}

Area FieldSamples::find_changes(const Patch& patch) const {
  const Patch before = read(patch.area);
  Area changed, turned;
  std::size_t k = 0;
  for (std::int32_t row = patch.area.north; row <= patch.area.south; ++row) {
    for (std::int32_t col = patch.area.west; col <= patch.area.east; ++col, ++k) {
      for (std::size_t layer = 0; layer < layer_count(); ++layer) {
        const std::vector<float>& now = patch.layers[layer];
        if (!now.empty() && !is_same(now[k], before.layers[layer][k])) changed.include(col, row);
      }
      if (std::isnan(patch.layers[kHeights][k]) != std::isnan(before.layers[kHeights][k])) turned.include(col, row);
    }
  }
  if (turned.is_empty()) return changed;
  const Area near = turned.grown(1).clipped(area_);
  changed.include(near.west, near.north);
  changed.include(near.east, near.south);
  return changed;
}

Result<void> FieldSamples::check(const Patch& patch) const {
  for (std::size_t channel = 0; channel < channel_count(); ++channel) {
    const std::size_t layer = this->channel(channel);
    std::vector<float> held;
    if (patch.layers[layer].empty())
      rings_[layer].read(patch.area, area_, (held = std::vector<float>(count_of(patch.area))).data());
    const std::vector<float>& values = held.empty() ? patch.layers[layer] : held;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isfinite(values[k]) || std::isnan(patch.layers[kHeights][k])) continue;
      const auto cols = static_cast<std::size_t>(patch.area.cols());
      return fail(
          ErrorKind::kInput,
          fmt::format("channel {} at column {}, row {} has no value, though the height has one: give it a value, or "
                      "make the height a void",
                      channel + 1, static_cast<std::size_t>(patch.area.west - area_.west) + k % cols,
                      static_cast<std::size_t>(patch.area.north - area_.north) + k / cols));
    }
  }
  return {};
}

void FieldSamples::write(const Patch& patch) {
  for (std::size_t layer = 0; layer < layer_count(); ++layer) {
    if (!patch.layers[layer].empty()) rings_[layer].write(patch.area, patch.layers[layer]);
  }
}

void FieldSamples::swap(Patch& patch) {
  Patch before = read(patch.area);
  write(patch);
  for (std::size_t layer = 0; layer < layer_count(); ++layer) {
    if (!patch.layers[layer].empty()) patch.layers[layer].swap(before.layers[layer]);
  }
}

std::vector<Patch> FieldSamples::move(const Area& to) {
  std::vector<Patch> left;
  for (const Area& part : area_.beyond(to)) {
    if (!part.is_empty()) left.push_back(read(part));
  }
  // Samples that enter are stored in the places of those that leave.
  for (const Patch& patch : left) {
    for (SampleRing& ring : rings_) ring.clear(patch.area);
  }
  area_ = to;
  return left;
}

void FieldSamples::move_back(const Area& to, const std::vector<Patch>& left) {
  area_ = to;
  for (const Patch& patch : left) write(patch);
}

}  // namespace scarp::live
