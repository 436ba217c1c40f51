#include "tiles/tile_mesh_parts.h"

#include <algorithm>
#include <cmath>

#include "tiles/sine.h"

namespace scarp {
namespace {

constexpr double kRadians = 0.017453292519943295;

struct Degrees {
  double longitude = 0, latitude = 0;
};

Degrees degrees_at(const DegreeBox& box, double u, double v) {
  return {box.west + (box.east - box.west) * (u / 32767), box.south + (box.north - box.south) * (v / 32767)};
}

}  // namespace

std::int32_t normal_reach(std::int32_t steps) { return std::max(1, steps / 256); }

std::vector<std::array<std::uint8_t, 2>> node_normals(const TerrainTile& tile, const TileNodes& nodes,
                                                      const TileRows& rows, const TileGrid& grid, const Globe& globe) {
  const std::int32_t steps = nodes.steps(), reach = normal_reach(steps);
  const DegreeBox box = grid.bounds_of(tile.id);
  const NodeWindow window = grid.window_of(tile.id, steps);
  std::vector<std::array<std::uint8_t, 2>> normals;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    const std::int32_t col = nearest_node(tile.u[k], steps), row = rows.nearest(tile.v[k]);
    // The node's degrees by its place on the globe, so that tiles on either side of an edge have the same bits.
    const double longitude = window.longitude(window.col + col), latitude = window.latitude(window.row + row);
    const Space up = Globe::up(longitude, latitude);
    Space normal = up;
    if (!window.is_pole(window.row + row)) {
      const Globe::Radii radii = globe.radii(latitude);
      // Beyond the grid's ends the last row's nodes are repeated.
      const double north_of = window.latitude(std::max<std::int64_t>(window.row + row - reach, 0)),
                   south_of = window.latitude(std::min(window.row + row + reach, window.last_row()));
      const double across = 2 * reach * ((box.east - box.west) / steps * kRadians),
                   down = (north_of - south_of) * kRadians;
      const double rise_east =
          (double{nodes.at(col + reach, row)} - double{nodes.at(col - reach, row)}) / (across * radii.parallel);
      const double rise_north =
          (double{nodes.at(col, row - reach)} - double{nodes.at(col, row + reach)}) / (down * radii.meridian);
      const auto [sin_lon, cos_lon] = sine_of_degrees(longitude);
      const auto [sin_lat, cos_lat] = sine_of_degrees(latitude);
      const Space east{-sin_lon, cos_lon, 0}, north{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
      normal = normalized(sum(up, sum(scaled(east, -rise_east), scaled(north, -rise_north))));
    }
    normals.push_back(encode_octahedral(normal));
  }
  return normals;
}

std::vector<Space> positions_in_space(const TerrainTile& tile, const TileGrid& grid, const Globe& globe) {
  const DegreeBox box = grid.bounds_of(tile.id);
  std::vector<Space> positions;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    const Degrees at = degrees_at(box, tile.u[k], tile.v[k]);
    positions.push_back(globe.position(at.longitude, at.latitude, tile.quantum * tile.heights[k]));
  }
  return positions;
}

double largest_sag(const TerrainTile& tile, const TileGrid& grid, const Globe& globe) {
  const std::vector<Space> positions = positions_in_space(tile, grid, globe);
  const auto square = [&](std::uint32_t a, std::uint32_t b) {
    const Space way = sum(positions[a], scaled(positions[b], -1));
    return dot(way, way);
  };
  double worst = 0;
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    std::array<double, 3> sides{square(tile.triangles[k], tile.triangles[k + 1]),
                                square(tile.triangles[k + 1], tile.triangles[k + 2]),
                                square(tile.triangles[k + 2], tile.triangles[k])};
    std::sort(sides.begin(), sides.end());
    const auto [a, b, c] = sides;
    // 16 times the square of the area, by Heron's formula.
    const double area = 4 * a * b - (a + b - c) * (a + b - c);
    worst = std::max(worst, c >= a + b || area <= 0 ? c / 4 : a * b * c / area);
  }
  return worst / (2 * globe.least_radius());
}

Mesh decoded(const TerrainTile& tile, std::int32_t steps) {
  Mesh mesh;
  mesh.triangles = tile.triangles;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    mesh.positions.push_back(static_cast<double>(tile.u[k]) * steps / 32767);
    mesh.positions.push_back(static_cast<double>(tile.v[k]) * steps / 32767);
    mesh.positions.push_back(tile.quantum * tile.heights[k]);
  }
  return mesh;
}

}  // namespace scarp
