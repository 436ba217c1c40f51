#include "tiles/mesh/tile_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "globe/row_range.h"

namespace scarp::tiles {
namespace {

/// A point at most this · side length beyond a side counts as inside. Rounding contributes 1e-7.
constexpr double kSlack = 1e-6;
/// Maximum number of triangles in a walk before all are scanned: on non-Delaunay meshes a walk may cycle.
constexpr int kLongestWalk = 64;

template <class Facet>
std::array<double, 3> weights(const Facet& facet, double u, double v) {
  std::array<double, 3> weight{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    weight[k] = (facet.x[b] - facet.x[a]) * (v - facet.y[a]) - (facet.y[b] - facet.y[a]) * (u - facet.x[a]);
  }
  return weight;
}

}  // namespace

TileSurface::TileSurface(const TerrainTile& tile, double limit, Counts counts)
    : counts_(std::move(counts)), side_(tile.units), limit_(limit) {
  facets_.resize(tile.triangles.size() / 3);
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = tile.triangles[3 * t + k];
      facets_[t].x[k] = tile.u[v];
      facets_[t].y[k] = tile.v[v];
      facets_[t].z[k] = tile.quantum * tile.heights[v];
    }
  }
  link(tile);
  if (std::isfinite(limit_)) far_.resize(facets_.size());
}

void TileSurface::link(const TerrainTile& tile) {
  // Linked lists of half-edges by first vertex.
  const std::vector<std::uint32_t>& corners = tile.triangles;
  std::vector<std::uint32_t> first(tile.u.size(), kNone), next(corners.size());
  for (std::uint32_t h = 0; h < corners.size(); ++h) next[h] = std::exchange(first[corners[h]], h);
  const auto end_of = [&](std::uint32_t h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
  for (std::uint32_t h = 0; h < corners.size(); ++h) {
    for (std::uint32_t other = first[end_of(h)]; other != kNone; other = next[other]) {
      if (end_of(other) == corners[h]) facets_[h / 3].beyond[(h % 3 + 2) % 3] = other / 3;
    }
  }
}

std::uint32_t TileSurface::find(std::uint32_t near, double u, double v) const {
  for (int step = 0; step < kLongestWalk; ++step) {
    const Facet& facet = facets_[near];
    const std::array<double, 3> weight = weights(facet, u, v);
    double least = -kSlack;
    std::uint32_t beyond = kNone;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] >= least || facet.beyond[k] == kNone) continue;
      least = weight[k];
      beyond = facet.beyond[k];
    }
    if (beyond == kNone) return near;
    near = beyond;
  }
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < facets_.size(); ++t) {
    const std::array<double, 3> weight = weights(facets_[t], u, v);
    const double depth = std::min({weight[0], weight[1], weight[2]});
    if (depth <= deepest) continue;
    deepest = depth;
    near = t;
  }
  return near;
}

void TileSurface::note(std::uint32_t facet, const FarPoint& point) {
  if (counts_ && !counts_(point.u, point.v)) return;
  worst_ = std::max(worst_, point.error);
  if (point.error > limit_ && point.error > far_[facet].error) far_[facet] = point;
}

void TileSurface::judge(const PointRow& row) {
  const auto [first, end] =
      globe::range_within(row.u, row.step_u, row.v, row.step_v, row.heights.size(), {0, 0, side_, side_});
  if (first >= end) return;
  const auto u_of = [&](std::size_t i) { return row.u + row.step_u * static_cast<double>(i); };
  const auto v_of = [&](std::size_t i) { return row.v + row.step_v * static_cast<double>(i); };
  std::uint32_t at = start_ = find(start_, u_of(first), v_of(first));
  for (std::size_t i = first; i < end;) {
    const Facet& facet = facets_[at];
    const std::array<double, 3> weight = weights(facet, u_of(i), v_of(i));
    double area = 0, height = 0, rise = 0, last = static_cast<double>(end - 1 - i);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double change = (facet.x[b] - facet.x[a]) * row.step_v - (facet.y[b] - facet.y[a]) * row.step_u;
      area += weight[k];
      height += weight[k] * facet.z[k];
      rise += change * facet.z[k];
      if (change < 0 && facet.beyond[k] != kNone) last = std::min(last, (weight[k] + kSlack) / -change);
    }
    height /= area;
    rise /= area;
    const auto run = static_cast<std::size_t>(std::max(last, 0.0)) + 1;
    const float* const heights = row.heights.data() + i;
    for (std::size_t k = 0; k < run; ++k) {
      const double error = std::abs(height + rise * static_cast<double>(k) - double{heights[k]});
      if (error > std::min(worst_, limit_)) note(at, {u_of(i + k), v_of(i + k), double{heights[k]}, error});
    }
    i += run;
    if (i < end) at = find(at, u_of(i), v_of(i));
  }
}

std::vector<FarPoint> TileSurface::far_points() const {
  std::vector<FarPoint> points;
  for (const FarPoint& point : far_) {
    if (point.error > 0) points.push_back(point);
  }
  return points;
}

}  // namespace scarp::tiles
