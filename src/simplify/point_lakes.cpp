// Lakes in scattered points, and normals of the surface through all of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/ring_bands.h"
#include "grid/keep_points.h"
#include "refine/point_surface.h"
#include "scarp/points.h"

namespace scarp {

namespace {

/// The heights along rings, each vertex and some places between; empty if all lie beyond the points.
std::vector<double> heights_along(const std::vector<const Line*>& rings, const PointSurface& surface, double spacing) {
  constexpr double kMostPlaces = 4096;
  std::vector<double> heights;
  bool is_over_points = false;
  for (const Line* ring : rings) {
    for (std::size_t k = 0; k + 1 < ring->points.size(); ++k) {
      const auto &a = ring->points[k], &b = ring->points[k + 1];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      const auto count = static_cast<std::size_t>(std::clamp(2 * length / spacing, 1.0, kMostPlaces));
      for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        const auto height = surface.at(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
        is_over_points = is_over_points || height.distance == 0;
        heights.push_back(height.z);
      }
    }
  }
  if (!is_over_points) heights.clear();
  return heights;
}

RingBands bands_of(const std::vector<const Line*>& rings) {
  std::vector<PlaceRing> places;
  for (const Line* ring : rings) {
    places.emplace_back();
    for (std::size_t k = 0; k + 1 < ring->points.size(); ++k)
      places.back().push_back({ring->points[k][0], ring->points[k][1]});
  }
  return RingBands(places);
}

/// By vertex, the normals of the triangles around it, each as long as twice the triangle's area; z > 0.
std::vector<std::array<double, 3>> sum_normals(const Mesh& mesh) {
  std::vector<std::array<double, 3>> sums(mesh.vertex_count(), {0, 0, 0});
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* corners = &mesh.triangles[3 * t];
    const auto a = mesh.vertex(corners[0]), b = mesh.vertex(corners[1]), c = mesh.vertex(corners[2]);
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double wx = c[0] - a[0], wy = c[1] - a[1], wz = c[2] - a[2];
    for (std::size_t k = 0; k < 3; ++k) {
      auto& [x, y, z] = sums[corners[k]];
      x += uy * wz - uz * wy;
      y += uz * wx - ux * wz;
      z += ux * wy - uy * wx;
    }
  }
  return sums;
}

}  // namespace

Result<std::vector<PointLake>> level_lakes(std::span<const Line> rings, double percentile, PointSet& points) {
  SCARP_TRY(const auto& surface, PointSurface::make(points));
  std::map<std::uint32_t, std::vector<const Line*>> polygons;
  for (const Line& ring : rings) polygons[ring.polygon].push_back(&ring);
  std::vector<bool> is_of_line(points.size());
  for (const PointLine& line : points.lines) {
    for (const std::uint32_t point : line.points) is_of_line[point] = true;
  }
  std::vector<PointLake> lakes;
  std::vector<Line> shores;
  std::vector<bool> stays(points.size(), true);
  for (const auto& [polygon, lake_rings] : polygons) {
    PointLake lake{lake_rings.front()->name, std::numeric_limits<double>::quiet_NaN(), 0};
    std::vector<double> heights = heights_along(lake_rings, surface, surface.spacing());
    if (!heights.empty()) {
      const auto rank = std::lround(percentile / 100 * static_cast<double>(heights.size() - 1));
      std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
      lake.level = heights[static_cast<std::size_t>(rank)];
      const RingBands bands = bands_of(lake_rings);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!stays[i] || is_of_line[i] || !bands.holds(points.x[i], points.y[i])) continue;
        stays[i] = false;
        ++lake.dropped;
      }
      for (const Line* ring : lake_rings) {
        shores.push_back(*ring);
        for (auto& place : shores.back().points) place[2] = lake.level;
      }
    }
    lakes.push_back(std::move(lake));
  }
  keep_points(points, [&](std::size_t i) { return stays[i]; });
  SCARP_RETURN_IF_ERROR(add_lines(shores, points));
  return lakes;
}

Result<std::vector<float>> point_normals(const PointSet& points, const Mesh& mesh) {
  SCARP_TRY(const auto& surface, PointSurface::make(points));
  const double reach = surface.spacing();
  std::vector<std::array<double, 3>> sums = sum_normals(mesh);
  std::vector<float> normals;
  normals.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    const auto east = surface.at(p[0] + reach, p[1]), west = surface.at(p[0] - reach, p[1]),
               north = surface.at(p[0], p[1] + reach), south = surface.at(p[0], p[1] - reach);
    if (east.distance + west.distance + north.distance + south.distance == 0)
      sums[v] = {west.z - east.z, south.z - north.z, 2 * reach};
    const auto& [x, y, z] = sums[v];
    const double length = std::hypot(x, y, z);
    for (const double part : {x, y, z}) normals.push_back(static_cast<float>(part / length));
  }
  return normals;
}

}  // namespace scarp
