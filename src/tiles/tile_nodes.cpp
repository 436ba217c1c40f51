#include "tiles/tile_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/bits.h"
#include "base/parallel.h"
#include "tiles/coarse_nodes.h"
#include "tiles/tile_maker.h"

namespace scarp {
namespace {

/// Rows that a thread reads at a time.
constexpr int kRowsTogether = 256;

}  // namespace

NodeArea land_of(const TileGrid& grid, TileId id, std::int32_t steps) {
  const NodeWindow window = grid.window_of(id, steps);
  const NodeRange columns = grid.land_columns(window.per_turn), rows = grid.land_rows(window.per_turn);
  return {static_cast<std::int32_t>(std::max<std::int64_t>(rows.first - window.row, 0)),
          static_cast<std::int32_t>(std::min<std::int64_t>(columns.last - window.col, steps)), steps};
}

Result<TileNodes> TileNodes::read(const PyramidPlan& plan, TileId id, std::int32_t steps, std::int32_t halo,
                                  const NodeSource& source) {
  TileNodes nodes;
  nodes.steps_ = steps;
  nodes.halo_ = halo;
  nodes.land_ = land_of(plan.grid, id, steps);
  const NodeWindow window = plan.grid.window_of(id, steps, halo);
  const std::int64_t first_row = plan.grid.window_of(id, steps).row - halo;
  const std::int32_t side = nodes.side();
  const std::int64_t from = window.row, to = window.row + window.rows - 1;
  nodes.heights_.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const auto row_of = [&](std::int64_t row) {
    return nodes.heights_.begin() + static_cast<std::ptrdiff_t>((row - first_row) * side);
  };
  auto read = source.read(window, std::span(nodes.heights_)
                                      .subspan(static_cast<std::size_t>((from - first_row) * side),
                                               static_cast<std::size_t>(side) * static_cast<std::size_t>(window.rows)));
  if (!read) return tl::unexpected(read.error());
  for (std::int64_t row = first_row; row < from; ++row) std::copy_n(row_of(from), side, row_of(row));
  for (std::int64_t row = to + 1; row < first_row + side; ++row) std::copy_n(row_of(to), side, row_of(row));
  nodes.fill_voids(plan.background);
  return nodes;
}

void TileNodes::fill_voids(float background) {
  const auto side = static_cast<std::size_t>(steps_) + 1;
  const auto is_missing = [](float height) { return std::isnan(height); };
  if (std::all_of(heights_.begin(), heights_.end(), is_missing)) {  // most tiles of coarse levels
    has_heights_ = false;
    is_flat_ = true;
    voids_.assign(side * side, true);
    std::fill(heights_.begin(), heights_.end(), background);
    return;
  }
  std::size_t missing = 0;
  for (std::int32_t row = 0; row <= steps_; ++row) {
    const float* const heights = &heights_[index(0, row)];
    for (std::int32_t col = 0; col <= steps_; ++col) missing += std::isnan(heights[col]);
  }
  has_heights_ = missing < side * side;
  if (missing > 0) {
    voids_.reserve(side * side);
    for (std::int32_t row = 0; row <= steps_; ++row) {
      for (std::int32_t col = 0; col <= steps_; ++col) voids_.push_back(std::isnan(at(col, row)));
    }
  }
  std::size_t others = 0;
  for (float& height : heights_) {
    height = std::isnan(height) ? background : height;
    others += height != background;
  }
  is_flat_ = others == 0;
}

bool TileNodes::has_heights_around(double col, double row) const {
  const auto before = [&](double place) {
    return std::clamp(static_cast<std::int32_t>(std::floor(place)), 0, steps_ - 1);
  };
  const std::size_t side = static_cast<std::size_t>(steps_) + 1,
                    first = static_cast<std::size_t>(before(row)) * side + static_cast<std::size_t>(before(col));
  return !voids_[first] && !voids_[first + 1] && !voids_[first + side] && !voids_[first + side + 1];
}

TileNodes TileNodes::flat(const PyramidPlan& plan, TileId id, std::int32_t least_steps) {
  // Above the blocks, where the land ends between nodes, as many as tiles have there.
  const std::int32_t most = id.z >= plan.block_level ? steps_of(plan, id.z) : 2 * kCoarseCells;
  TileNodes nodes;
  nodes.steps_ = least_steps;
  nodes.halo_ = 1;
  const auto end_of = [&](std::int32_t steps) {
    const NodeArea land = land_of(plan.grid, id, steps);
    return std::pair{std::int64_t{land.top} * most / steps, std::int64_t{land.right} * most / steps};
  };
  while (nodes.steps_ < most && end_of(nodes.steps_) != end_of(most)) nodes.steps_ *= 2;
  nodes.land_ = land_of(plan.grid, id, nodes.steps_);
  nodes.heights_.assign(static_cast<std::size_t>(nodes.side()) * static_cast<std::size_t>(nodes.side()),
                        plan.background);
  return nodes;
}

Result<HeldNodes> HeldNodes::read(const NodeWindow& window, const NodeSource& source, int threads) {
  HeldNodes held;
  held.source_ = &source;
  held.window_ = window;
  const auto cols = static_cast<std::size_t>(window.cols);
  held.heights_.resize(cols * static_cast<std::size_t>(window.rows));
  const auto bands = static_cast<std::size_t>((window.rows + kRowsTogether - 1) / kRowsTogether);
  std::vector<Result<void>> read(bands);
  parallel_for(bands, threads, [&](std::size_t k) {
    NodeWindow band = window;
    const int first = static_cast<int>(k) * kRowsTogether;
    band.row += first;
    band.rows = std::min(kRowsTogether, window.rows - first);
    read[k] = source.read(
        band, std::span(held.heights_)
                  .subspan(cols * static_cast<std::size_t>(first), cols * static_cast<std::size_t>(band.rows)));
  });
  for (const Result<void>& one : read) {
    if (!one) return tl::unexpected(one.error());
  }
  return held;
}

bool HeldNodes::has_heights() const {
  return std::any_of(heights_.begin(), heights_.end(), [](float z) { return !std::isnan(z); });
}

std::uint64_t HeldNodes::hash() const {
  if (!has_heights()) return 0;
  std::uint64_t hash = 0x9e3779b97f4a7c15;
  for (const float height : heights_) {
    // One pattern of bits for all that are no height.
    const std::uint32_t bits = std::isnan(height) ? 0x7fc00000 : bit_cast<std::uint32_t>(height);
    hash = (hash ^ bits) * 0xff51afd7ed558ccd;
    hash ^= hash >> 32;
  }
  return std::max<std::uint64_t>(hash, 1);
}

Result<void> HeldNodes::read(const NodeWindow& window, std::span<float> out) const {
  for (std::int64_t row = 0; row < window.rows; ++row) {
    const auto from = (window.row - window_.row + row) * window_.cols + (window.col - window_.col);
    std::copy_n(heights_.begin() + static_cast<std::ptrdiff_t>(from), window.cols,
                out.begin() + static_cast<std::ptrdiff_t>(row * window.cols));
  }
  return {};
}

}  // namespace scarp
