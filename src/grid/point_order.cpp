#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/curve.h"
#include "base/radix_sort.h"
#include "grid/keep_points.h"
#include "scarp/points.h"

namespace scarp {

namespace {

/// Maps one coordinate to 22 bits.
class Steps {
 public:
  explicit Steps(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    least_ = *least;
    const double size = *most - *least;
    scale_ = size > 0 && std::isfinite(size) ? kMost / size : 0;
  }
  std::uint64_t operator()(double value) const {
    return static_cast<std::uint64_t>(std::clamp((value - least_) * scale_, 0.0, kMost));
  }

 private:
  static constexpr double kMost = (1 << 22) - 1;
  double least_ = 0, scale_ = 0;
};

struct Placed {
  std::uint64_t key;
  std::uint32_t point;
};

template <class T>
void permute(const std::vector<Placed>& order, std::vector<T>& values) {
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const Placed& k : order) sorted.push_back(values[k.point]);
  values.swap(sorted);
}

}  // namespace

void sort_points(PointSet& points) {
  if (points.size() == 0 || !grid::has_finite_places(points)) return;
  std::vector<Placed> order;
  order.reserve(points.size());
  const Steps x(points.x), y(points.y);
  for (std::uint32_t i = 0; i < points.size(); ++i) order.push_back({curve_place(x(points.x[i]), y(points.y[i])), i});
  radix_sort(order, [](const Placed& k) { return k.key; });
  for (std::vector<double>* values : {&points.x, &points.y, &points.z}) permute(order, *values);
  if (!points.tolerances.empty()) {
    points.tolerances.resize(points.size(), std::numeric_limits<float>::infinity());
    permute(order, points.tolerances);
  }
  if (points.lines.empty() && points.boundary.empty()) return;
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i].point] = i;
  for (PointLine& line : points.lines) {
    for (std::uint32_t& point : line.points) point = place[point];
  }
  for (auto& ring : points.boundary) {
    for (std::uint32_t& corner : ring) corner = place[corner];
  }
}

}  // namespace scarp
