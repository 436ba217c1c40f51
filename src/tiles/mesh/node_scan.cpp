// Corners of triangles are multiples of the tile's units, and nodes are multiples of 1 / steps of a side. All are
// integers as multiples of 1 / (units · steps), and the edge functions are exact in 64 bits.
#include "tiles/mesh/node_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp::tiles {
namespace {

constexpr std::int32_t kLanes = 4;

/// A point in multiples of 1 / (units · steps), y to the south. Two neighbouring nodes are `units` multiples apart.
struct UnitPoint {
  std::int64_t x = 0, y = 0;
};

/// A triangle's side, restricted to the rows that it crosses.
class Side {
 public:
  Side(UnitPoint from, UnitPoint to, std::int64_t node)
      : from_(from), dx_(to.x - from.x), dy_(to.y - from.y), node_(node) {
    slope_ = static_cast<double>(dx_) / static_cast<double>(dy_);
  }
  /// The first column of nodes on the side or east of it. REQUIRES: not level.
  std::int32_t first(std::int32_t row) const {
    std::int32_t col = near(row);
    while (is_east(col - 1, row)) --col;
    while (!is_east(col, row)) ++col;
    return col;
  }
  /// The last column of nodes on the side or west of it.
  std::int32_t last(std::int32_t row) const {
    std::int32_t col = near(row);
    while (is_west(col + 1, row)) ++col;
    while (!is_west(col, row)) --col;
    return col;
  }

 private:
  /// A column next to the side, within the rounding error.
  std::int32_t near(std::int32_t row) const {
    const auto y = static_cast<double>(node_ * row - from_.y);
    return static_cast<std::int32_t>(
        std::floor((static_cast<double>(from_.x) + slope_ * y) / static_cast<double>(node_)));
  }
  std::int64_t east_of(std::int32_t col, std::int32_t row) const {
    const std::int64_t across = (node_ * col - from_.x) * dy_ - (node_ * row - from_.y) * dx_;
    return dy_ > 0 ? across : -across;
  }
  bool is_east(std::int32_t col, std::int32_t row) const { return east_of(col, row) >= 0; }
  bool is_west(std::int32_t col, std::int32_t row) const { return east_of(col, row) <= 0; }

  UnitPoint from_;
  std::int64_t dx_, dy_, node_;
  double slope_;
};

class NodeScan {
 public:
  NodeScan(const TileNodes& nodes, std::int64_t node, double limit)
      : nodes_(nodes),
        node_(node),
        limit_(limit),
        side_(static_cast<std::size_t>(nodes.steps()) + 1),
        covered_(side_ * side_, 0) {}

  void scan(const std::array<UnitPoint, 3>& corners, const std::array<double, 3>& heights) {
    // From north to south.
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corners[a].y < corners[b].y; });
    const UnitPoint top = corners[order[0]], middle = corners[order[1]], bottom = corners[order[2]];
    const auto row_from = [this](std::int64_t y) { return static_cast<std::int32_t>((y + node_ - 1) / node_); };
    const auto row_to = [this](std::int64_t y) { return static_cast<std::int32_t>(y / node_); };
    const std::int64_t area = (middle.x - top.x) * (bottom.y - top.y) - (middle.y - top.y) * (bottom.x - top.x);
    plane(corners, heights);
    worst_ = limit_;
    const Side long_side(top, bottom, node_);
    const auto rows = [&](const Side& short_side, std::int32_t first, std::int32_t last) {
      for (std::int32_t row = first; row <= last; ++row) {
        if (area > 0)
          look_at(row, long_side.first(row), short_side.last(row));
        else
          look_at(row, short_side.first(row), long_side.last(row));
      }
    };
    // The middle corner's row belongs to the upper part, or to the lower one if the upper one is level.
    const std::int32_t last_above = row_to(middle.y);
    if (top.y < middle.y) rows(Side(top, middle, node_), row_from(top.y), last_above);
    const std::int32_t first_below = row_from(middle.y);
    if (middle.y < bottom.y)
      rows(Side(middle, bottom, node_), top.y < middle.y ? last_above + 1 : first_below, row_to(bottom.y));
    if (worst_ > limit_) errors_.worst.push_back(worst_at_);
  }

  NodeErrors finish() {
    errors_.largest = largest_;
    const NodeArea& land = nodes_.land();
    for (std::int32_t row = land.top; row <= land.bottom; ++row) {
      const auto first = covered_.begin() + static_cast<std::ptrdiff_t>(side_ * static_cast<std::size_t>(row));
      errors_.uncovered += static_cast<std::uint64_t>(std::count(first, first + land.right + 1, 0));
    }
    return std::move(errors_);
  }

 private:
  void plane(const std::array<UnitPoint, 3>& corners, const std::array<double, 3>& heights) {
    const auto [a, b, c] = corners;
    const auto bx = static_cast<double>(b.x - a.x), by = static_cast<double>(b.y - a.y);
    const auto cx = static_cast<double>(c.x - a.x), cy = static_cast<double>(c.y - a.y);
    const double bz = heights[1] - heights[0], cz = heights[2] - heights[0];
    const auto area = static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    base_ = a;
    height_ = heights[0];
    slope_x_ = (bz * cy - cz * by) / area;
    slope_y_ = (cz * bx - bz * cx) / area;
  }

  void look_at(std::int32_t row, std::int32_t first, std::int32_t last) {
    if (first > last) return;
    const double start = height_ + slope_y_ * static_cast<double>(node_ * row - base_.y) +
                         slope_x_ * static_cast<double>(node_ * first - base_.x);
    const double step = slope_x_ * static_cast<double>(node_);
    const float* const heights = nodes_.from(first, row);
    const std::int32_t count = last - first + 1, whole = count / kLanes * kLanes;
    std::fill_n(covered_.begin() + static_cast<std::ptrdiff_t>(side_ * static_cast<std::size_t>(row)) + first, count,
                std::uint8_t{1});
    const auto error = [&](std::int32_t i) { return std::abs(start + step * i - double{heights[i]}); };
    // Maxima in lanes, for vectorization.
    std::array<double, kLanes> lanes{};
    for (std::int32_t i = 0; i < whole; i += kLanes) {
      for (std::int32_t k = 0; k < kLanes; ++k) {
        const double one = error(i + k);
        lanes[static_cast<std::size_t>(k)] =
            one > lanes[static_cast<std::size_t>(k)] ? one : lanes[static_cast<std::size_t>(k)];
      }
    }
    double most = *std::max_element(lanes.begin(), lanes.end());
    for (std::int32_t i = whole; i < count; ++i) most = std::max(most, error(i));
    largest_ = std::max(largest_, most);
    if (!(most > worst_)) return;
    worst_ = most;
    std::int32_t at = 0;
    while (error(at) != most) ++at;
    worst_at_ = {first + at, row};
  }

  const TileNodes& nodes_;
  std::int64_t node_;
  double limit_;
  std::size_t side_;
  std::vector<std::uint8_t> covered_;
  NodeErrors errors_;
  double largest_ = 0;
  UnitPoint base_;
  double height_ = 0, slope_x_ = 0, slope_y_ = 0, worst_ = 0;
  SampleAt worst_at_{};
};

}  // namespace

NodeErrors scan_nodes(const TerrainTile& tile, const TileNodes& nodes, double limit) {
  NodeScan scan(nodes, tile.units, limit);
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    std::array<UnitPoint, 3> corners;
    std::array<double, 3> heights{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = tile.triangles[k + i];
      corners[i] = {std::int64_t{tile.u[v]} * nodes.steps(), std::int64_t{tile.units - tile.v[v]} * nodes.steps()};
      heights[i] = tile.quantum * tile.heights[v];
    }
    scan.scan(corners, heights);
  }
  return scan.finish();
}

}  // namespace scarp::tiles
