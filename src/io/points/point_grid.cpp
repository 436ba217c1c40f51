#include "io/points/point_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::io {
namespace {

constexpr double kMostOffNode = 0.02;  // share of a step
constexpr double kMostNodes = 20;      // for a point
constexpr int kLeastLines = 3;

/// The nodes along one axis; `count` is 0 if there are none.
struct Axis {
  double low = 0, step = 0;
  int count = 0;

  int place(double value) const { return static_cast<int>(std::lround((value - low) / step)); }
};

/// The step is the mean of gaps near the median, since lines may be missing and decimals may be rounded.
Axis find_axis(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < kLeastLines) return {};
  std::vector<double> gaps;
  for (std::size_t k = 1; k < values.size(); ++k) gaps.push_back(values[k] - values[k - 1]);
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  const double median = gaps[gaps.size() / 2];
  double sum = 0;
  std::size_t usual = 0;
  for (const double gap : gaps) {
    if (std::abs(gap - median) > 0.5 * median) continue;
    sum += gap;
    ++usual;
  }
  const double extent = values.back() - values.front();
  const double lines = std::round(extent / (sum / static_cast<double>(usual)));
  if (!(lines < 1 << 30)) return {};
  const Axis axis{values.front(), extent / lines, static_cast<int>(lines) + 1};
  for (const double value : values) {
    if (std::abs(value - (axis.low + axis.place(value) * axis.step)) > kMostOffNode * axis.step) return {};
  }
  return axis;
}

/// True if two of three nodes have neighbours in their row and in their column.
bool are_neighbours(const PointGrid& grid, std::size_t points) {
  const auto cols = static_cast<std::size_t>(grid.cols), rows = static_cast<std::size_t>(grid.rows);
  std::size_t joined = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t col = 0; col < cols; ++col) {
      const double* node = &grid.heights[row * cols + col];
      if (std::isnan(*node)) continue;
      const bool across = (col > 0 && !std::isnan(node[-1])) || (col + 1 < cols && !std::isnan(node[1]));
      const bool down = (row > 0 && !std::isnan(*(node - cols))) || (row + 1 < rows && !std::isnan(node[cols]));
      joined += across && down ? 1 : 0;
    }
  }
  return joined * 3 >= points * 2;
}

}  // namespace

std::optional<PointGrid> find_grid(const PointSet& points) {
  const Axis x = find_axis(points.x);
  if (x.count == 0) return std::nullopt;
  const Axis y = find_axis(points.y);
  const double nodes = static_cast<double>(x.count) * y.count;
  if (y.count == 0 || nodes > kMostNodes * static_cast<double>(points.size())) return std::nullopt;
  PointGrid grid{x.count, y.count, x.low, y.low + (y.count - 1) * y.step, x.step, y.step, 0, {}};
  grid.heights.assign(static_cast<std::size_t>(nodes), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int row = y.count - 1 - y.place(points.y[i]);
    double& height = grid.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(x.count) +
                                  static_cast<std::size_t>(x.place(points.x[i]))];
    if (!std::isnan(height)) return std::nullopt;
    height = points.z[i];
  }
  grid.missing = grid.heights.size() - points.size();
  if (!are_neighbours(grid, points.size())) return std::nullopt;
  return grid;
}

}  // namespace scarp::io
