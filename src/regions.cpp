// Distances are those of P. F. Felzenszwalb and D. P. Huttenlocher, "Distance Transforms of Sampled Functions", Theory
// of Computing 8, 2012: the lower envelope of parabolas, along the rows, then along the columns.
#include "scarp/regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

namespace scarp {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// In samples.
struct Place {
  double col, row;
};

/// The samples of one region.
class Marks {
 public:
  explicit Marks(const RegionGrid& grid)
      : grid_(grid),
        determinant_(grid.affine[1] * grid.affine[5] - grid.affine[2] * grid.affine[4]),
        marks_(static_cast<std::size_t>(grid.cols) * static_cast<std::size_t>(grid.rows), 0) {}

  void add(const std::vector<Line>& lines) {
    std::map<std::uint32_t, std::vector<const Line*>> polygons;
    for (const Line& line : lines) {
      add_course(line);
      if (line.is_ring()) polygons[line.polygon].push_back(&line);
    }
    for (const auto& [polygon, rings] : polygons) fill(rings);
  }
  bool any() const { return std::find(marks_.begin(), marks_.end(), 1) != marks_.end(); }
  bool has(std::size_t i) const { return marks_[i] != 0; }

 private:
  Place place_of(const std::array<double, 3>& point) const {
    const auto& a = grid_.affine;
    const double x = point[0] - a[0], y = point[1] - a[3];
    return {(a[5] * x - a[2] * y) / determinant_, (a[1] * y - a[4] * x) / determinant_};
  }
  void mark(int col, int row) {
    marks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.cols) + static_cast<std::size_t>(col)] = 1;
  }

  /// Narrows [begin, end] to where from + t · span lies in [−1/2, size − 1/2]. False if that is nowhere.
  static bool narrow(double from, double span, int size, double& begin, double& end) {
    const double least = -0.5, most = size - 0.5;
    if (span == 0) return from >= least && from <= most;
    const double a = (least - from) / span, b = (most - from) / span;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    return begin <= end;
  }

  /// The samples nearest to points of a line, a quarter of a sample apart.
  void add_course(const Line& line) {
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      const Place p = place_of(line.points[k]), q = place_of(line.points[k + 1]);
      double begin = 0, end = 1;
      if (!narrow(p.col, q.col - p.col, grid_.cols, begin, end) ||
          !narrow(p.row, q.row - p.row, grid_.rows, begin, end))
        continue;
      const double length = std::max(std::abs(q.col - p.col), std::abs(q.row - p.row)) * (end - begin);
      const auto steps = static_cast<std::int64_t>(std::ceil(4 * length)) + 1;
      for (std::int64_t i = 0; i <= steps; ++i) {
        const double at = begin + (end - begin) * static_cast<double>(i) / static_cast<double>(steps);
        const auto near = [](double place, int size) {
          return static_cast<int>(std::clamp(std::floor(place + 0.5), 0.0, size - 1.0));
        };
        mark(near(p.col + at * (q.col - p.col), grid_.cols), near(p.row + at * (q.row - p.row), grid_.rows));
      }
    }
  }

  /// Row by row, between every two crossings with the rings.
  void fill(const std::vector<const Line*>& rings) {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(grid_.rows));
    for (const Line* ring : rings) {
      for (std::size_t k = 0; k + 1 < ring->points.size(); ++k) {
        Place p = place_of(ring->points[k]), q = place_of(ring->points[k + 1]);
        if (p.row > q.row) std::swap(p, q);
        // Half open, so that a vertex on a row counts once.
        const double first = std::max(std::ceil(p.row), 0.0), last = std::min(std::ceil(q.row), double(grid_.rows));
        for (double row = first; row < last; ++row)
          crossings[static_cast<std::size_t>(row)].push_back(p.col + (row - p.row) / (q.row - p.row) * (q.col - p.col));
      }
    }
    for (int row = 0; row < grid_.rows; ++row) {
      std::vector<double>& at = crossings[static_cast<std::size_t>(row)];
      std::sort(at.begin(), at.end());
      for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
        const double first = std::max(std::ceil(at[i]), 0.0), last = std::min(at[i + 1], grid_.cols - 1.0);
        for (double col = first; col <= last; ++col) mark(static_cast<int>(col), row);
      }
    }
  }

  const RegionGrid& grid_;
  double determinant_;
  std::vector<std::uint8_t> marks_;
};

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

std::vector<double> distances(const Marks& marks, const RegionGrid& grid) {
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
    Marks marks(grid);
    marks.add(regions[k].lines);
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
