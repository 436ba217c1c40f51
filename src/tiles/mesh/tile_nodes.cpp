#include "tiles/mesh/tile_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scarp {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

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
  nodes.heights_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), kUnknown);
  const auto row_of = [&](std::int64_t row) {
    return nodes.heights_.begin() + static_cast<std::ptrdiff_t>((row - first_row) * side);
  };
  const NodeWindow land = source.land(window);
  const std::size_t count = static_cast<std::size_t>(land.cols) * static_cast<std::size_t>(land.rows);
  std::vector<float> part(land.cols < side ? count : 0);
  const std::span<float> out = land.cols < side ? std::span(part) : std::span(&*row_of(land.row), count);
  SCARP_RETURN_IF_ERROR(count > 0 ? source.read(land, out) : Result<void>());
  for (std::int32_t j = 0; !part.empty() && j < land.rows; ++j)
    std::copy_n(&part[static_cast<std::size_t>(j) * static_cast<std::size_t>(land.cols)], land.cols,
                row_of(land.row + j) + static_cast<std::ptrdiff_t>(land.col - window.col));
  for (std::int64_t row = first_row; row < from; ++row) std::copy_n(row_of(from), side, row_of(row));
  for (std::int64_t row = to + 1; row < first_row + side; ++row) std::copy_n(row_of(to), side, row_of(row));
  const auto first = static_cast<std::int32_t>(land.col - window.col) - halo;
  nodes.fill_voids(plan.background, std::max(first, 0), std::min(first + land.cols, steps + 1));
  return nodes;
}

void TileNodes::fill_voids(float background, std::int32_t first_col, std::int32_t end_col) {
  const auto side = static_cast<std::size_t>(steps_) + 1;
  const auto is_missing = [](float height) { return std::isnan(height); };
  if (std::all_of(heights_.begin(), heights_.end(), is_missing)) {  // most tiles of coarse levels
    has_heights_ = false;
    is_flat_ = true;
    voids_.assign(side * side, true);
    std::fill(heights_.begin(), heights_.end(), background);
    return;
  }
  std::size_t present = 0;
  for (std::int32_t row = 0; row <= steps_; ++row) {
    const float* const heights = &heights_[index(0, row)];
    for (std::int32_t col = first_col; col < end_col; ++col) present += !std::isnan(heights[col]);
  }
  has_heights_ = present > 0;
  if (present < side * side) {
    voids_.assign(side * side, true);
    for (std::int32_t row = 0; row <= steps_; ++row) {
      for (std::int32_t col = first_col; col < end_col; ++col)
        voids_[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(col)] = std::isnan(at(col, row));
    }
  }
  for (float& height : heights_) height = std::isnan(height) ? background : height;
  is_flat_ = std::all_of(heights_.begin(), heights_.end(), [&](float height) { return height == background; });
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
  // Above the blocks the land may end between nodes; tiles then have this many steps.
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

}  // namespace scarp
