#include "lines/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::lines {

namespace {

/// The index between two positions where the heights are farthest from the chord, or where heights begin if an end has
/// none. 0: the chord suffices.
std::size_t find_split(const std::vector<double>& heights, double tolerance, std::size_t gap, std::size_t first,
                       std::size_t last) {
  const bool begins_beyond = std::isnan(heights[first]), ends_beyond = std::isnan(heights[last]);
  const double rise = (heights[last] - heights[first]) / static_cast<double>(last - first);
  double worst = tolerance;
  std::size_t at = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    if (std::isnan(heights[i])) continue;
    if (begins_beyond) return i;
    const double allowed = i - first < gap || last - i < gap ? 2 : 1;
    const double error = std::abs(heights[first] + rise * static_cast<double>(i - first) - heights[i]) / allowed;
    if (!ends_beyond && !(error > worst)) continue;
    worst = error;
    at = i;
  }
  return at;
}

}  // namespace

std::vector<std::size_t> find_bends(const std::vector<double>& heights, double tolerance, std::size_t gap) {
  std::vector<std::size_t> bends;
  if (heights.size() < 3 || find_split(heights, tolerance, gap, 0, heights.size() - 1) == 0) return bends;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, heights.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const std::size_t at = find_split(heights, tolerance, gap, first, last);
    if (at == 0) continue;
    bends.push_back(at);
    open.emplace_back(first, at);
    open.emplace_back(at, last);
  }
  std::sort(bends.begin(), bends.end());
  return bends;
}

}  // namespace scarp::lines
