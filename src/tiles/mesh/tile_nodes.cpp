#include "tiles/mesh/tile_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::tiles {

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
  const auto cols = static_cast<std::size_t>(window.cols);
  nodes.heights_.assign(cols * cols, plan.background);
  const auto row_of = [&](std::int64_t row) {
    return nodes.heights_.begin() + static_cast<std::ptrdiff_t>(row - first_row) * window.cols;
  };
  // If a tile is larger than the raster, most of its nodes are outside the land.
  const NodeWindow land = source.land(window);
  const std::size_t count = static_cast<std::size_t>(land.cols) * static_cast<std::size_t>(land.rows);
  std::vector<float> part(land.cols < window.cols ? count : 0);
  const std::span<float> out = land.cols < window.cols ? std::span(part) : std::span(&*row_of(land.row), count);
  SCARP_RETURN_IF_ERROR(count > 0 ? source.read(land, out) : Result<void>());
  const auto left = static_cast<std::int32_t>(land.col - window.col) - halo,
             top = static_cast<std::int32_t>(land.row - first_row) - halo;
  nodes.fill_voids(out, {left, top, land.cols, land.rows}, plan.background);
  for (std::int32_t j = 0; !part.empty() && j < land.rows; ++j)
    std::copy_n(&part[static_cast<std::size_t>(j) * static_cast<std::size_t>(land.cols)], land.cols,
                row_of(land.row + j) + static_cast<std::ptrdiff_t>(land.col - window.col));
  const std::int64_t from = window.row, to = window.row + window.rows - 1;
  for (std::int64_t row = first_row; row < from; ++row) std::copy_n(row_of(from), window.cols, row_of(row));
  for (std::int64_t row = to + 1; row < first_row + window.cols; ++row)
    std::copy_n(row_of(to), window.cols, row_of(row));
  return nodes;
}

void TileNodes::fill_voids(std::span<float> heights, const Part& part, float background) {
  const auto side = static_cast<std::size_t>(steps_) + 1;
  const std::int32_t first_col = std::max(part.left, 0), end_col = std::min(part.left + part.cols, steps_ + 1);
  const std::int32_t first_row = std::max(part.top, 0), end_row = std::min(part.top + part.rows, steps_ + 1);
  const auto height_at = [&](std::int32_t col, std::int32_t row) {
    return heights[static_cast<std::size_t>(row - part.top) * static_cast<std::size_t>(part.cols) +
                   static_cast<std::size_t>(col - part.left)];
  };
  std::size_t present = 0;
  for (std::int32_t row = first_row; row < end_row; ++row) {
    for (std::int32_t col = first_col; col < end_col; ++col) present += !std::isnan(height_at(col, row));
  }
  has_heights_ = present > 0;
  if (present < side * side) voids_.assign(side * side, true);
  for (std::int32_t row = first_row; !voids_.empty() && row < end_row; ++row) {
    for (std::int32_t col = first_col; col < end_col; ++col)
      voids_[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(col)] = std::isnan(height_at(col, row));
  }
  for (float& height : heights) height = std::isnan(height) ? background : height;
  is_flat_ = std::all_of(heights.begin(), heights.end(), [&](float height) { return height == background; });
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

}  // namespace scarp::tiles
