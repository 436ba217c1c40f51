// Distances are those of P. F. Felzenszwalb and D. P. Huttenlocher, "Distance Transforms of Sampled Functions", Theory
// of Computing 8, 2012: the lower envelope of parabolas, along the rows, then along the columns.
#include "scarp/regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "line_marks.h"

namespace scarp {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Squared distances along one line of samples that are `cell` apart: values[i] becomes the least of values[j] + (cell
/// · (i − j))².
class LineTransform {
 public:
  explicit LineTransform(std::size_t size) : apex_(size), from_(size + 1), result_(size) {}

  template <class At>
  void run(std::size_t size, double cell, const At& at) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
      if (std::isinf(at(i))) continue;
      double begins = -kFar;
      for (; count > 0; --count) {
        begins = crossing(apex_[count - 1], i, cell, at);
        if (begins > from_[count - 1]) break;
        begins = -kFar;
      }
      apex_[count] = i;
      from_[count++] = begins;
    }
    if (count == 0) return;
    from_[count] = kFar;
    for (std::size_t i = 0, k = 0; i < size; ++i) {
      while (from_[k + 1] < static_cast<double>(i)) ++k;
      const double away = cell * (static_cast<double>(i) - static_cast<double>(apex_[k]));
      result_[i] = at(apex_[k]) + away * away;
    }
    for (std::size_t i = 0; i < size; ++i) at(i) = result_[i];
  }

 private:
  /// Where the parabola of j falls below that of i < j.
  template <class At>
  static double crossing(std::size_t i, std::size_t j, double cell, const At& at) {
    const double x = static_cast<double>(i), y = static_cast<double>(j);
    return ((at(j) - at(i)) / (cell * cell) + y * y - x * x) / (2 * (y - x));
  }

  std::vector<std::size_t> apex_;
  std::vector<double> from_, result_;
};

std::vector<double> distances(const LineMarks& marks, const RegionGrid& grid) {
  const auto cols = static_cast<std::size_t>(grid.cols), rows = static_cast<std::size_t>(grid.rows);
  std::vector<double> squared(cols * rows, kFar);
  for (std::size_t i = 0; i < squared.size(); ++i) {
    if (marks.has(i)) squared[i] = 0;
  }
  LineTransform line(std::max(cols, rows));
  for (std::size_t row = 0; row < rows; ++row)
    line.run(cols, grid.cell_x, [&](std::size_t i) -> double& { return squared[row * cols + i]; });
  for (std::size_t col = 0; col < cols; ++col)
    line.run(rows, grid.cell_y, [&](std::size_t i) -> double& { return squared[i * cols + col]; });
  for (double& value : squared) value = std::sqrt(value);
  return squared;
}

float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return double{rounded} > value ? std::nextafter(rounded, 0.0f) : rounded;
}

}  // namespace

std::vector<float> region_tolerances(std::span<const Region> regions, const RegionGrid& grid,
                                     std::vector<bool>* found) {
  const double beyond = grid.beyond.value_or(kFar);
  std::vector<float> bounds(static_cast<std::size_t>(grid.cols) * static_cast<std::size_t>(grid.rows),
                            rounded_down(beyond));
  if (found != nullptr) found->assign(regions.size(), false);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    LineMarks marks(grid.affine, grid.cols, grid.rows);
    for (const Line& line : regions[k].lines) marks.add_course(line);
    marks.add_polygons(regions[k].lines);
    if (!marks.any()) continue;
    if (found != nullptr) (*found)[k] = true;
    const double inside = regions[k].tolerance;
    const std::vector<double> away = grid.falloff > 0 ? distances(marks, grid) : std::vector<double>();
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (marks.has(i)) {
        bounds[i] = std::min(bounds[i], rounded_down(inside));
      } else if (grid.falloff > 0 && away[i] < grid.falloff) {
        bounds[i] = std::min(bounds[i], rounded_down(inside + (beyond - inside) * (away[i] / grid.falloff)));
      }
    }
  }
  return bounds;
}

}  // namespace scarp
