#include "pieces/tiling.h"

#include <algorithm>

namespace scarp::pieces {

namespace {

std::vector<std::int32_t> cut(std::int32_t samples, std::int32_t side) {
  const std::int64_t steps = samples - 1;
  const std::int64_t parts = std::max<std::int64_t>(1, (steps + side / 2) / side);
  std::vector<std::int32_t> places;
  for (std::int64_t i = 0; i <= parts; ++i) places.push_back(static_cast<std::int32_t>(steps * i / parts));
  return places;
}

}  // namespace

Tiling::Tiling(std::int32_t cols, std::int32_t rows, std::int32_t side) : x_(cut(cols, side)), y_(cut(rows, side)) {}

refine::TileWindow Tiling::window(std::size_t tile) const {
  const std::size_t i = tile % per_row(), j = tile / per_row();
  return {x_[i], y_[j], x_[i + 1] - x_[i] + 1, y_[j + 1] - y_[j] + 1};
}

refine::SharedSides Tiling::shared(std::size_t tile) const {
  const std::size_t i = tile % per_row(), j = tile / per_row();
  return {i > 0, j > 0, i + 1 < per_row(), j + 1 < per_column()};
}

std::vector<BorderLine> shared_lines(const refine::TileWindow& window, const refine::SharedSides& shared) {
  const std::int32_t last_col = window.col + window.cols - 1, last_row = window.row + window.rows - 1;
  std::vector<BorderLine> lines;
  if (shared.left) lines.push_back({window.col, window.row, window.rows - 1, true});
  if (shared.top) lines.push_back({window.col, window.row, window.cols - 1, false});
  if (shared.right) lines.push_back({last_col, window.row, window.rows - 1, true});
  if (shared.bottom) lines.push_back({window.col, last_row, window.cols - 1, false});
  return lines;
}

}  // namespace scarp::pieces
