// The laws of tile meshes, with access to their parts.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "geom/exact_error.h"
#include "laws/fields.h"
#include "refine/domain.h"
#include "tin/tile_mesh.h"

namespace scarp::testing {

/// The first broken law, "" if none: (1) links are mutual, along the same edge, and constraints agree; (2) triangles
/// are positive; (3) edges without a neighbour lie on the rectangle's border; (4) the areas add up to the rectangle and
/// V − E + F = 1; (5) locally Delaunay except across constraints; (6) outside changes only across constraints.
inline std::string verify_tile_mesh(const tin::TileMesh& mesh, std::int32_t cols, std::int32_t rows) {
  std::int64_t area2 = 0;
  std::size_t border = 0;
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    const tin::TileMesh::Record& record = mesh[t];
    const std::array<Point, 3> p{geom::point_of(record.corners[0]), geom::point_of(record.corners[1]),
                                 geom::point_of(record.corners[2])};
    if (orient(p[0], p[1], p[2]) <= 0) return fmt::format("triangle {} is not positive", t);
    area2 += orient(p[0], p[1], p[2]);
    for (unsigned k = 0; k < 3; ++k) {
      const tin::TileMesh::Link link = record.links[k];
      const Point a = p[k], b = p[(k + 1) % 3];
      if (link == tin::TileMesh::kBorder) {
        ++border;
        const bool on_border =
            (a.x == b.x && (a.x == 0 || a.x == cols - 1)) || (a.y == b.y && (a.y == 0 || a.y == rows - 1));
        if (!on_border) return fmt::format("edge {} of {} has no neighbour within the rectangle", k, t);
        continue;
      }
      const tin::TileMesh::Record& other = mesh[tin::TileMesh::triangle_of(link)];
      const unsigned e = tin::TileMesh::edge_of(link);
      if (other.links[e] != (t << 3 | (link & 4) | k)) return fmt::format("edge {} of {} is not linked back", k, t);
      if (other.corners[e] != record.corners[(k + 1) % 3] || other.corners[(e + 1) % 3] != record.corners[k])
        return fmt::format("edge {} of {} runs elsewhere beyond", k, t);
      if (tin::TileMesh::is_constrained(link)) continue;
      if (mesh.is_outside(t) != mesh.is_outside(tin::TileMesh::triangle_of(link)))
        return fmt::format("outside changes across the free edge {} of {}", k, t);
      if (geom::in_circle(p[0], p[1], p[2], geom::point_of(other.corners[(e + 2) % 3])) > 0)
        return fmt::format("edge {} of {} is not Delaunay", k, t);
    }
  }
  if (area2 != 2 * std::int64_t{cols - 1} * (rows - 1)) return "the areas do not add up to the rectangle";
  const std::size_t edges = (3 * mesh.triangle_count() + border) / 2;
  if (mesh.vertex_count() + mesh.triangle_count() != edges + 1) return "Euler's formula does not hold";
  return "";
}

/// A triangle: its points, the smallest first, and its outside mark.
using NamedTriangle = std::array<geom::TilePoint, 4>;

inline NamedTriangle name_triangle(std::array<geom::TilePoint, 3> corners, bool outside) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return {corners[0], corners[1], corners[2], outside};
}

/// All triangles, sorted: the mesh without its numbering.
inline std::vector<NamedTriangle> triangles_of(const tin::TileMesh& mesh) {
  std::vector<NamedTriangle> triangles;
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t)
    triangles.push_back(name_triangle(mesh[t].corners, mesh.is_outside(t)));
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}
inline std::vector<NamedTriangle> triangles_of(const tin::Triangulation& tin) {
  std::vector<NamedTriangle> triangles;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    triangles.push_back(name_triangle(
        {geom::tile_point(a.x, a.y), geom::tile_point(b.x, b.y), geom::tile_point(c.x, c.y)}, tin.is_outside(t)));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// True if four corners around a free edge lie on a circle, so that the Delaunay triangulation is not unique.
inline bool has_ties(const tin::Triangulation& tin) {
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) == tin::kNone || tin.is_constrained(h)) continue;
    const auto [a, b, c] = tin.corners(h / 3);
    if (geom::in_circle(a, b, c, tin.point(tin.origin(tin::Triangulation::previous(tin.twin(h))))) == 0) return true;
  }
  return false;
}

inline std::int64_t outside_area2(const tin::TileMesh& mesh) {
  std::int64_t area2 = 0;
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    const auto& c = mesh[t].corners;
    if (mesh.is_outside(t)) area2 += orient(geom::point_of(c[0]), geom::point_of(c[1]), geom::point_of(c[2]));
  }
  return area2;
}
inline std::int64_t outside_area2(const tin::Triangulation& tin) {
  std::int64_t area2 = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    if (tin.is_outside(t)) area2 += orient(a, b, c);
  }
  return area2;
}

/// True if the triangle's plane, a mean of the corners' heights, is within the threshold of the sample by more than a
/// few roundings. Exact arithmetic fails if magnitudes differ extremely.
inline bool is_clearly_kept(const std::array<Point, 3>& corners, const std::array<float, 3>& heights, Point p,
                            double sample, double threshold) {
  double sum = 0, magnitude = std::abs(sample);
  for (std::size_t k = 0; k < 3; ++k) {
    sum += static_cast<double>(orient(corners[(k + 1) % 3], corners[(k + 2) % 3], p)) * double{heights[k]};
    magnitude += std::abs(double{heights[k]});
  }
  const double error = std::abs(sum / static_cast<double>(orient(corners[0], corners[1], corners[2])) - sample);
  return error + 0x1p-48 * magnitude < threshold;
}

/// A sample of the closed triangle that breaks the bound as a real number, or a corner that is nodata; "" if none.
/// Scans every sample of the bounding box.
inline std::string find_broken_bound(const grid::Raster& raster, const std::array<Point, 3>& corners,
                                     double threshold) {
  std::array<float, 3> heights;
  for (std::size_t k = 0; k < 3; ++k) {
    heights[k] = raster.at(corners[k]);
    if (!raster.is_valid(corners[k])) return fmt::format("the vertex ({}, {}) is nodata", corners[k].x, corners[k].y);
  }
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  for (Point p{left, top}; p.y <= bottom; ++p.y) {
    for (p.x = left; p.x <= right; ++p.x) {
      const bool inside = orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
                          orient(corners[2], corners[0], p) >= 0;
      if (!inside || !raster.is_valid(p) || is_clearly_kept(corners, heights, p, raster.at(p), threshold)) continue;
      if (geom::exceeds_exactly(corners, heights, p, raster.at(p), threshold))
        return fmt::format("sample ({}, {}) breaks the bound {}", p.x, p.y, threshold);
    }
  }
  return "";
}

inline std::string find_broken_bound(const grid::Raster& raster, const tin::TileMesh& mesh, double threshold) {
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_outside(t)) continue;
    const auto& c = mesh[t].corners;
    const std::string broken =
        find_broken_bound(raster, {geom::point_of(c[0]), geom::point_of(c[1]), geom::point_of(c[2])}, threshold);
    if (!broken.empty()) return broken;
  }
  return "";
}
inline std::string find_broken_bound(const grid::Raster& raster, const tin::Triangulation& tin, double threshold) {
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    const std::string broken = find_broken_bound(raster, tin.corners(t), threshold);
    if (!broken.empty()) return broken;
  }
  return "";
}

/// A slope in float32 whose samples differ from a plane only by rounding.
inline Field sloping_field(std::uint32_t seed, std::int32_t cols, std::int32_t rows) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  const double dx = uniform(), dy = uniform(), base = std::ldexp(uniform(), static_cast<int>(random() % 12));
  Field field{cols, rows, {}};
  for (std::int32_t y = 0; y < rows; ++y)
    for (std::int32_t x = 0; x < cols; ++x) field.samples.push_back(static_cast<float>(base + dx * x + dy * y));
  return field;
}

}  // namespace scarp::testing
