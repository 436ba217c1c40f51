// Lakes in scattered points, and normals of the surface through all of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/ring_bands.h"
#include "grid/keep_points.h"
#include "refine/point_surface.h"
#include "scarp/points.h"

namespace scarp {

namespace {

struct Polygon {
  std::vector<const Line*> rings;
  RingBands bands;
  Place low, high;

  explicit Polygon(std::vector<const Line*> of) : rings(std::move(of)), bands(places_of(rings)) {
    low = high = {rings.front()->points[0][0], rings.front()->points[0][1]};
    for (const auto& p : rings.front()->points) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
  }

  bool holds(double x, double y) const {
    return low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1] && bands.holds(x, y);
  }

 private:
  static std::vector<PlaceRing> places_of(const std::vector<const Line*>& rings) {
    std::vector<PlaceRing> places;
    for (const Line* ring : rings) {
      places.emplace_back();
      for (std::size_t k = 0; k + 1 < ring->points.size(); ++k)
        places.back().push_back({ring->points[k][0], ring->points[k][1]});
    }
    return places;
  }
};

/// Polygons, each with an outer ring and the holes after it.
std::vector<Polygon> polygons_of(std::span<const Line> rings) {
  std::vector<std::vector<const Line*>> groups;
  for (const Line& ring : rings) {
    if (ring.role == LineRole::kOuter || groups.empty()) groups.emplace_back();
    groups.back().push_back(&ring);
  }
  std::vector<Polygon> polygons;
  for (auto& group : groups) polygons.emplace_back(std::move(group));
  return polygons;
}

/// The heights at the vertices of a shore and some places between them; empty if all are outside the points.
std::vector<double> heights_along(const Polygon& polygon, const refine::PointSurface& surface, double spacing,
                                  std::uint64_t& beyond) {
  constexpr double kMostPlaces = 4096;
  std::vector<double> heights;
  bool is_over_points = false;
  for (const Line* ring : polygon.rings) {
    for (std::size_t k = 0; k + 1 < ring->points.size(); ++k) {
      const auto &a = ring->points[k], &b = ring->points[k + 1];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      const auto count = static_cast<std::size_t>(std::clamp(2 * length / spacing, 1.0, kMostPlaces));
      for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        const auto height = surface.at(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
        is_over_points = is_over_points || height.distance == 0;
        beyond += i == 0 && height.distance > 0;
        heights.push_back(height.z);
      }
    }
  }
  if (!is_over_points) heights.clear();
  return heights;
}

/// For each polygon, the first polygon that it meets at vertices, directly or through others.
std::vector<std::size_t> groups_of(const std::vector<Polygon>& polygons) {
  std::vector<std::size_t> first(polygons.size());
  std::map<Place, std::size_t> at;
  const auto root = [&](std::size_t k) {
    while (first[k] != k) k = first[k];
    return k;
  };
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    first[k] = k;
    for (const Line* ring : polygons[k].rings) {
      for (const auto& p : ring->points) {
        const std::size_t one = root(at.try_emplace({p[0], p[1]}, k).first->second), other = root(k);
        first[std::max(one, other)] = std::min(one, other);
      }
    }
  }
  for (std::size_t k = 0; k < polygons.size(); ++k) first[k] = root(k);
  return first;
}

/// Sets the levels, one for all lakes that meet; NaN if no shore is within the points.
void find_levels(const std::vector<Polygon>& polygons, const refine::PointSurface& surface, double percentile,
                 std::vector<PointLake>& lakes) {
  const double spacing = surface.spacing();
  const std::vector<std::size_t> groups = groups_of(polygons);
  std::vector<std::vector<double>> heights(polygons.size());
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const std::vector<double> own = heights_along(polygons[k], surface, spacing, lakes[k].beyond);
    heights[groups[k]].insert(heights[groups[k]].end(), own.begin(), own.end());
  }
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    std::vector<double>& of = heights[groups[k]];
    lakes[k].level = std::numeric_limits<double>::quiet_NaN();
    if (of.empty()) continue;
    const auto rank = std::lround(percentile / 100 * static_cast<double>(of.size() - 1));
    std::nth_element(of.begin(), of.begin() + rank, of.end());
    // Vertices between points have float32 heights, which must equal that of the shore.
    lakes[k].level = double{static_cast<float>(of[static_cast<std::size_t>(rank)])};
  }
}

/// For each vertex, the sum of the normals of its triangles, each as long as twice the triangle's area; z > 0.
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

Result<std::vector<PointLake>> level_lakes(std::span<const Line> rings, double percentile, PointSet& points,
                                           DuplicatePolicy duplicates) {
  SCARP_TRY(const auto& surface, refine::PointSurface::make(points, duplicates));
  const std::vector<Polygon> polygons = polygons_of(rings);
  std::vector<const PointLine*> line_of(points.size());
  for (const PointLine& line : points.lines) {
    for (const std::uint32_t point : line.points) line_of[point] = &line;
  }
  std::vector<PointLake> lakes(polygons.size());
  find_levels(polygons, surface, percentile, lakes);
  std::vector<Line> shores;
  std::vector<bool> stays(points.size(), true);
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    PointLake& lake = lakes[k];
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!polygons[k].holds(points.x[i], points.y[i])) continue;
      if (std::isnan(lake.level))
        return fail(ErrorKind::kInput,
                    fmt::format("the lake around ({:.10g}, {:.10g}) has no shore among the points: all lie in it",
                                points.x[i], points.y[i]));
      if (line_of[i] != nullptr && points.z[i] != lake.level)
        return fail(
            ErrorKind::kInput,
            fmt::format("{} runs through a lake: at ({:.10g}, {:.10g}) its height is {}, and the lake's {:.9g}; "
                        "end it at the shore",
                        line_of[i]->name, points.x[i], points.y[i], points.z[i], lake.level));
      if (line_of[i] != nullptr) continue;
      stays[i] = false;
      ++lake.dropped;
    }
    if (std::isnan(lake.level)) continue;
    for (const Line* ring : polygons[k].rings) {
      shores.push_back(*ring);
      for (auto& place : shores.back().points) place[2] = lake.level;
    }
  }
  grid::keep_points(points, [&](std::size_t i) { return stays[i]; });
  SCARP_RETURN_IF_ERROR(add_lines(shores, points));
  return lakes;
}

Result<std::vector<float>> point_normals(const PointSet& points, const Mesh& mesh, DuplicatePolicy duplicates) {
  std::vector<std::array<double, 3>> sums = sum_normals(mesh);
  if (points.lines.empty()) {
    SCARP_TRY(const auto& surface, refine::PointSurface::make(points, duplicates));
    const double reach = surface.spacing();
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto p = mesh.vertex(v);
      const auto east = surface.at(p[0] + reach, p[1]), west = surface.at(p[0] - reach, p[1]),
                 north = surface.at(p[0], p[1] + reach), south = surface.at(p[0], p[1] - reach);
      if (east.distance + west.distance + north.distance + south.distance == 0)
        sums[v] = {west.z - east.z, south.z - north.z, 2 * reach};
    }
  }
  std::vector<float> normals;
  normals.reserve(mesh.positions.size());
  for (const auto& [x, y, z] : sums) {
    const double length = std::hypot(x, y, z);
    for (const double part : {x, y, z}) normals.push_back(static_cast<float>(part / length));
  }
  return normals;
}

}  // namespace scarp
