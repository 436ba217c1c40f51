#include "tiles/nodes/held_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bits.h"
#include "base/parallel.h"

namespace scarp::tiles {
namespace {

/// Rows per read of a thread.
constexpr int kRowsTogether = 256;

}  // namespace

Result<HeldNodes> HeldNodes::read(const NodeWindow& window, const NodeSource& source, int threads) {
  HeldNodes held;
  held.source_ = &source;
  held.window_ = window;
  const NodeWindow& land = held.land_ = source.land(window);
  const auto cols = static_cast<std::size_t>(land.cols);
  held.heights_.resize(cols * static_cast<std::size_t>(land.rows));
  const auto bands =
      held.heights_.empty() ? 0 : static_cast<std::size_t>((land.rows + kRowsTogether - 1) / kRowsTogether);
  std::vector<Result<void>> read(bands);
  parallel_for(bands, threads, [&](std::size_t k) {
    NodeWindow band = land;
    const int first = static_cast<int>(k) * kRowsTogether;
    band.row += first;
    band.rows = std::min(kRowsTogether, land.rows - first);
    read[k] = source.read(
        band, std::span(held.heights_)
                  .subspan(cols * static_cast<std::size_t>(first), cols * static_cast<std::size_t>(band.rows)));
  });
  for (const Result<void>& one : read) {
    SCARP_RETURN_IF_ERROR(one);
  }
  return held;
}

bool HeldNodes::has_heights() const { return has_heights(window_); }

bool HeldNodes::has_heights(const NodeWindow& window) const {
  const NodeWindow part = land(window);
  for (std::int64_t row = part.row; row < part.row + part.rows; ++row) {
    const float* const from =
        &heights_[static_cast<std::size_t>((row - land_.row) * land_.cols + (part.col - land_.col))];
    if (std::any_of(from, from + part.cols, [](float z) { return !std::isnan(z); })) return true;
  }
  return false;
}

std::uint64_t HeldNodes::hash() const {
  if (!has_heights()) return 0;
  std::uint64_t hash = 0x9e3779b97f4a7c15;
  std::size_t k = 0;
  for (std::int32_t j = 0; j < land_.rows; ++j) {
    const std::int64_t row = (land_.row - window_.row + j) * window_.cols + (land_.col - window_.col);
    for (std::int32_t i = 0; i < land_.cols; ++i, ++k) {
      // These are skipped, so that the hash does not depend on the number of held nodes without heights.
      if (std::isnan(heights_[k])) continue;
      hash = (hash ^ bit_cast<std::uint32_t>(heights_[k]) ^ static_cast<std::uint64_t>(row + i) << 32) *
             0xff51afd7ed558ccd;
      hash ^= hash >> 32;
    }
  }
  return std::max<std::uint64_t>(hash, 1);
}

NodeWindow HeldNodes::land(const NodeWindow& window) const {
  NodeWindow part = window;
  part.col = std::max(window.col, land_.col);
  part.row = std::max(window.row, land_.row);
  part.cols = static_cast<int>(
      std::max<std::int64_t>(std::min(window.col + window.cols, land_.col + land_.cols) - part.col, 0));
  part.rows = static_cast<int>(
      std::max<std::int64_t>(std::min(window.row + window.rows, land_.row + land_.rows) - part.row, 0));
  if (part.cols == 0 || part.rows == 0) part.cols = part.rows = 0;
  return part;
}

Result<void> HeldNodes::read(const NodeWindow& window, std::span<float> out) const {
  const NodeWindow part = land(window);
  if (part.cols < window.cols || part.rows < window.rows)
    std::fill(out.begin(), out.end(), std::numeric_limits<float>::quiet_NaN());
  for (std::int64_t j = 0; j < part.rows; ++j) {
    const std::int64_t from = (part.row - land_.row + j) * land_.cols + (part.col - land_.col);
    std::copy_n(
        heights_.begin() + static_cast<std::ptrdiff_t>(from), part.cols,
        out.begin() + static_cast<std::ptrdiff_t>((part.row - window.row + j) * window.cols + (part.col - window.col)));
  }
  return {};
}

}  // namespace scarp::tiles
