#include "tiles/mesh/tile_mesh_parts.h"

#include <algorithm>
#include <cmath>

#include "globe/tile_positions.h"

namespace scarp::tiles {

std::int32_t normal_reach(std::int32_t steps) { return std::max(1, steps / 256); }

std::vector<std::array<std::uint8_t, 2>> node_normals(const TerrainTile& tile, const TileNodes& nodes,
                                                      const TileRows& rows, const TileGrid& grid,
                                                      const globe::Ground& ground) {
  const std::int32_t steps = nodes.steps(), reach = normal_reach(steps);
  const DegreeBox box = grid.bounds_of(tile.id);
  const NodeWindow window = grid.window_of(tile.id, steps);
  const NodeRange columns = grid.land_columns(window.per_turn), land = grid.land_rows(window.per_turn);
  std::vector<std::array<std::uint8_t, 2>> normals;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    const std::int32_t col = nearest_node(tile.u[k], steps, tile.units), row = rows.nearest(tile.v[k]);
    // Degrees of the node by its place on the globe, so that tiles on both sides of an edge have the same bits.
    const double longitude = window.longitude(window.col + col), latitude = window.latitude(window.row + row);
    const globe::Ground::Axes axes = ground.axes(longitude, latitude);
    globe::Space normal = axes.up;
    if (!window.is_pole(window.row + row)) {
      const globe::Globe::Radii radii = ground.metres(latitude);
      // The last nodes of the land are repeated outside.
      const double north_of = window.latitude(std::max(window.row + row - reach, land.first)),
                   south_of = window.latitude(std::min(window.row + row + reach, land.last));
      const std::int64_t west_of = std::max(window.col + col - reach, columns.first),
                         east_of = std::min(window.col + col + reach, columns.last);
      const double across = static_cast<double>(east_of - west_of) * ((box.east - box.west) / steps * ground.unit()),
                   down = (north_of - south_of) * ground.unit();
      const double rise_east =
          (double{nodes.at(col + reach, row)} - double{nodes.at(col - reach, row)}) / (across * radii.parallel);
      const double rise_north =
          (double{nodes.at(col, row - reach)} - double{nodes.at(col, row + reach)}) / (down * radii.meridian);
      normal = globe::normalized(globe::sum(
          axes.up, globe::sum(globe::scaled(axes.east, -rise_east), globe::scaled(axes.north, -rise_north))));
    }
    normals.push_back(globe::encode_octahedral(normal));
  }
  return normals;
}

double largest_sag(const TerrainTile& tile, const TileGrid& grid, const globe::Ground& ground) {
  const std::vector<globe::Space> positions = globe::positions_in_space(tile, grid, ground);
  const auto square = [&](std::uint32_t a, std::uint32_t b) {
    const globe::Space way = globe::sum(positions[a], globe::scaled(positions[b], -1));
    return globe::dot(way, way);
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
  return ground.sag(worst);
}

Mesh decoded(const TerrainTile& tile, std::int32_t steps) {
  Mesh mesh;
  mesh.triangles = tile.triangles;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    mesh.positions.push_back(static_cast<double>(tile.u[k]) * steps / tile.units);
    mesh.positions.push_back(static_cast<double>(tile.v[k]) * steps / tile.units);
    mesh.positions.push_back(tile.quantum * tile.heights[k]);
  }
  return mesh;
}

}  // namespace scarp::tiles
