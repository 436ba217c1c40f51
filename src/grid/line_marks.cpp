#include "grid/line_marks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace scarp::grid {
namespace {

constexpr std::size_t kMostCrossings = std::size_t{1} << 20;

/// Narrows [begin, end] to the values of t for which from + t · span is in [−1/2, size − 1/2]. False if empty.
bool narrow(double from, double span, int size, double& begin, double& end) {
  const double least = -0.5, most = size - 0.5;
  if (span == 0) return from >= least && from <= most;
  const double a = (least - from) / span, b = (most - from) / span;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin <= end;
}

}  // namespace

void LineRuns::add_course(const Line& line, double reach) {
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    const SamplePosition p = position_of(line.points[k]), q = position_of(line.points[k + 1]);
    double begin = 0, end = 1;
    if (!narrow(p.col, q.col - p.col, cols_, begin, end) || !narrow(p.row, q.row - p.row, rows_, begin, end)) continue;
    const double length = std::max(std::abs(q.col - p.col), std::abs(q.row - p.row)) * (end - begin);
    const auto steps = static_cast<std::int64_t>(std::ceil(4 * length)) + 1;
    for (std::int64_t i = 0; i <= steps; ++i) {
      const double at = begin + (end - begin) * static_cast<double>(i) / static_cast<double>(steps);
      const auto near = [](double place, int size) { return std::clamp(std::floor(place + 0.5), 0.0, size - 1.0); };
      const double col = near(p.col + at * (q.col - p.col), cols_), row = near(p.row + at * (q.row - p.row), rows_);
      const double beside = (col - p.col) * (q.row - p.row) - (row - p.row) * (q.col - p.col);
      if (std::abs(beside) <= reach * std::hypot(q.col - p.col, q.row - p.row))
        runs_.add({static_cast<int>(row), static_cast<int>(col), static_cast<int>(col) + 1});
    }
  }
}

void LineRuns::add_polygons(std::span<const Line> lines) {
  std::map<std::uint32_t, std::vector<const Line*>> polygons;
  for (const Line& line : lines) {
    if (line.is_ring()) polygons[line.polygon].push_back(&line);
  }
  for (const auto& [polygon, rings] : polygons) fill(rings, 0, rows_);
}

/// Marks samples row by row, between every two crossings with the rings. Crossings of ragged rings need many times the
/// vertices' memory, so their rows are processed in halves.
void LineRuns::fill(const std::vector<const Line*>& rings, int begin, int end) {
  std::vector<std::pair<int, double>> crossings;
  for (const Line* ring : rings) {
    for (std::size_t k = 0; k + 1 < ring->points.size(); ++k) {
      if (crossings.size() > kMostCrossings && end - begin > 1) {
        crossings = {};
        fill(rings, begin, begin + (end - begin) / 2);
        return fill(rings, begin + (end - begin) / 2, end);
      }
      SamplePosition p = position_of(ring->points[k]), q = position_of(ring->points[k + 1]);
      if (p.row > q.row) std::swap(p, q);
      // The interval is half open, so that a vertex on a row counts once.
      const double first = std::max(std::ceil(p.row), double{1} * begin),
                   last = std::min(std::ceil(q.row), double{1} * end);
      for (double row = first; row < last; ++row) {
        const double col = p.col + (row - p.row) / (q.row - p.row) * (q.col - p.col);
        if (!std::isnan(col)) crossings.emplace_back(static_cast<int>(row), col);
      }
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 0; i + 1 < crossings.size();) {
    const auto [row, from] = crossings[i];
    if (crossings[i + 1].first != row) {  // an odd crossing: the ring is not closed
      ++i;
      continue;
    }
    const double first = std::max(std::ceil(from), 0.0), last = std::min(crossings[i + 1].second, cols_ - 1.0);
    if (first <= last) runs_.add({row, static_cast<int>(first), static_cast<int>(last) + 1});
    i += 2;
  }
}

}  // namespace scarp::grid
