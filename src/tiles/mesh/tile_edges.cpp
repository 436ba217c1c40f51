#include "tiles/mesh/tile_edges.h"

#include <algorithm>
#include <cmath>

#include "scarp/options.h"

namespace scarp::tiles {
namespace {

/// Number of tolerances to try, each 63/64 of the one before; then every node becomes a vertex.
constexpr int kTrials = 64;
/// Share of the max error; the rest covers rounding in the judge.
constexpr double kShare = 511.0 / 512;

/// Largest error of the line through `vertices` as clients decode it.
double edge_error(const EdgeNodes& nodes, std::span<const std::int32_t> vertices, double quantum) {
  const auto place = [&](std::int32_t node) { return nodes.decoded[static_cast<std::size_t>(node)]; };
  const auto height = [&](std::int32_t node) {
    return quantum * quanta_of(double{nodes.heights[static_cast<std::size_t>(node)]}, quantum);
  };
  double worst = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < nodes.heights.size(); ++i) {
    while (k + 2 < vertices.size() && place(vertices[k + 1]) < nodes.places[i]) ++k;
    const double from = place(vertices[k]), to = place(vertices[k + 1]);
    const double low = height(vertices[k]), high = height(vertices[k + 1]);
    const double line = low + (high - low) * ((nodes.places[i] - from) / (to - from));
    worst = std::max(worst, std::abs(line - double{nodes.heights[i]}));
  }
  return worst;
}

}  // namespace

std::int32_t quanta_of(double height, double quantum) {
  return static_cast<std::int32_t>(std::floor(height / quantum + 0.5));
}

std::vector<std::int32_t> choose_edge_vertices(const EdgeNodes& nodes, const PyramidLevel& level,
                                               std::span<const std::int32_t> forced) {
  const auto steps = static_cast<std::int32_t>(nodes.heights.size()) - 1;
  std::vector<float> rounded = nodes.heights;
  for (float& z : rounded) z = static_cast<float>(level.quantum * quanta_of(double{z}, level.quantum));
  const std::int32_t segments = std::min<std::int32_t>(level.segments, steps), side = steps / segments;
  std::vector<std::int32_t> given(forced.begin(), forced.end());
  for (std::int32_t i = 0; i <= steps; i += side) given.push_back(i);
  std::sort(given.begin(), given.end());
  given.erase(std::unique(given.begin(), given.end()), given.end());
  double tolerance = level.max_error - level.quantum / 2;
  for (int trial = 0; trial < kTrials; ++trial, tolerance *= 63.0 / 64) {
    std::vector<std::int32_t> vertices{0};
    for (std::size_t k = 0; k + 1 < given.size(); ++k) {
      const std::int32_t first = given[k];
      for (const std::int32_t i :
           simplify_edge(std::span(rounded).subspan(static_cast<std::size_t>(first),
                                                    static_cast<std::size_t>(given[k + 1] - first) + 1),
                         tolerance)) {
        if (i > 0) vertices.push_back(first + i);
      }
    }
    if (edge_error(nodes, vertices, level.quantum) <= kShare * level.max_error) return vertices;
  }
  std::vector<std::int32_t> all(nodes.heights.size());
  for (std::int32_t i = 0; i <= steps; ++i) all[static_cast<std::size_t>(i)] = i;
  return all;
}

}  // namespace scarp::tiles
