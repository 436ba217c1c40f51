#include "tiles/water/water_shapes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "globe/node_places.h"
#include "grid/line_marks.h"

namespace scarp::tiles {
namespace {

/// Points of a river are at most 1 / kStepsPerNode of a node apart.
constexpr double kStepsPerNode = 4;

}  // namespace

void NodesAround::add(double col, double row) {
  left_ = std::min(left_, col);
  right_ = std::max(right_, col);
  top_ = std::min(top_, row);
  bottom_ = std::max(bottom_, row);
}

std::optional<NodeBox> NodesAround::box(const TileWaters& waters) const {
  const globe::NodePlaces places(waters.grid, waters.per_turn);
  const DegreeBox& covered = waters.covered;
  const bool goes_round = covered.east - covered.west >= 360;
  const double left = goes_round ? left_ : std::max(left_, places.col(covered.west)),
               right = goes_round ? right_ : std::min(right_, places.col(covered.east)),
               top = std::max(top_, places.row(covered.north)), bottom = std::min(bottom_, places.row(covered.south));
  if (!(left <= right && top <= bottom)) return std::nullopt;
  const auto at = [](double place) { return static_cast<std::int64_t>(place); };
  NodeBox box;
  box.col = at(std::floor(left)) - 2;
  box.row = std::max<std::int64_t>(at(std::floor(top)) - 2, 0);
  const std::int64_t last_row = waters.grid.last_row(waters.per_turn);
  const auto count = [](std::int64_t first, std::int64_t last) {
    return static_cast<int>(std::min<std::int64_t>(last - first + 1, kMostNodes + 1));
  };
  box.cols = count(box.col, at(std::ceil(right)) + 2);
  box.rows = count(box.row, std::min(at(std::ceil(bottom)) + 2, last_row));
  return box;
}

std::vector<Line> lines_of(const TileLake& lake) {
  std::vector<Line> lines;
  for (const auto& ring : lake.rings) {
    Line line;
    line.name = lake.name;
    line.role = lines.empty() ? LineRole::kOuter : LineRole::kHole;
    line.polygon = 0;
    for (const auto& [col, row] : ring) line.points.push_back({col, row, NAN});
    lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<NodeBox> box_of(const TileLake& lake, const TileWaters& waters) {
  NodesAround around;
  for (const auto& ring : lake.rings) {
    for (const auto& [col, row] : ring) around.add(col, row);
  }
  const std::optional<NodeBox> box = around.box(waters);
  if (!box || std::max(box->cols, box->rows) > kMostNodes) return std::nullopt;
  return box;
}

std::vector<grid::SampleRun> nodes_of(const TileLake& lake, const NodeBox& box) {
  grid::LineRuns marks(affine_of(box), box.cols, box.rows);
  const std::vector<Line> rings = lines_of(lake);
  marks.add_polygons(rings);
  // Like flatten_lakes(): nodes within rounding of the shore are part of the lake.
  for (const Line& ring : rings) marks.add_course(ring, 1.0 / 128);
  return marks.runs();
}

std::vector<RiverNode> nodes_of(const TileRiver& river) {
  std::vector<RiverNode> nodes;
  for (std::size_t k = 0; k + 1 < river.course.size(); ++k) {
    const auto &p = river.course[k], &q = river.course[k + 1];
    if (std::isnan(p[2]) || std::isnan(q[2])) continue;
    const double length = std::max(std::abs(q[0] - p[0]), std::abs(q[1] - p[1]));
    const double steps = std::ceil(kStepsPerNode * length) + 1;
    for (double i = 0; i <= steps; ++i) {
      const auto between = [&](std::size_t axis) { return p[axis] + i / steps * (q[axis] - p[axis]); };
      nodes.push_back({static_cast<std::int64_t>(std::floor(between(1) + 0.5)),
                       static_cast<std::int64_t>(std::floor(between(0) + 0.5)), static_cast<float>(between(2))});
    }
  }
  const auto key = [](const RiverNode& node) { return std::tuple(node.row, node.col, node.height); };
  std::sort(nodes.begin(), nodes.end(), [&](const RiverNode& a, const RiverNode& b) { return key(a) < key(b); });
  const auto is_same = [](const RiverNode& a, const RiverNode& b) { return a.row == b.row && a.col == b.col; };
  nodes.erase(std::unique(nodes.begin(), nodes.end(), is_same), nodes.end());
  return nodes;
}

}  // namespace scarp::tiles
