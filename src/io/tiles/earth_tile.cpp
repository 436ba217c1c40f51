// A tile on the lattice of its level, in space.
#include <algorithm>
#include <cmath>
#include <limits>

#include "globe/ground.h"
#include "globe/powers.h"
#include "io/tiles3d.h"

namespace scarp::io {
namespace {

/// Distance of a horizon point too far away to hide a tile from viewers near a planet.
constexpr double kFarOut = 1000;

std::array<std::int64_t, 3> nearest_lattice_point(const globe::Space& at, const globe::Space& steps) {
  std::array<std::int64_t, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) point[k] = static_cast<std::int64_t>(std::floor(at[k] / steps[k] + 0.5));
  return point;
}

/// Degrees give shared vertices the same bits on both sides of an edge, also across the antimeridian.
globe::Space shared_position(const TerrainTile& tile, std::size_t v, const TileGrid& grid, const globe::Ground& ground,
                             double below = 0) {
  const DegreeBox box = grid.bounds_of(tile.id);
  const double units = tile.units;
  const double longitude = tile.u[v] == tile.units ? box.east : box.west + (box.east - box.west) * (tile.u[v] / units);
  const double latitude =
      tile.v[v] == tile.units ? box.north : box.south + (box.north - box.south) * (tile.v[v] / units);
  const bool is_around = longitude == 180 && grid.turns().size() > 1;
  return ground.position(is_around ? -180 : longitude, latitude, tile.quantum * tile.heights[v] - below);
}

bool has_tile_beside(const TileGrid& grid, TileId id, int to_east, int to_north) {
  const std::int64_t columns = grid.columns(id.z), y = std::int64_t{id.y} + to_north;
  std::int64_t x = std::int64_t{id.x} + to_east;
  if (grid.turns().size() > 1) x = (x + columns) % columns;
  if (x < 0 || x >= columns || y < 0 || y >= grid.rows(id.z)) return false;
  return grid.has({id.z, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)});
}

enum class Way { kUp, kDown };

/// The vertices of an edge in order.
std::vector<std::uint32_t> vertices_along(const std::vector<std::uint16_t>& across, std::uint16_t edge,
                                          const std::vector<std::uint16_t>& along, Way way) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < across.size(); ++v) {
    if (across[v] == edge) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
    return way == Way::kUp ? along[a] < along[b] : along[b] < along[a];
  });
  return vertices;
}

TileFacts find_facts(const TerrainTile& tile, const EarthTile& placed, const globe::Ground& ground) {
  std::vector<globe::Space> positions;
  for (const auto& offset : placed.offsets) {
    globe::Space at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = placed.steps[k] * static_cast<double>(placed.origin[k] + std::int64_t{offset[k]});
    positions.push_back(at);
  }
  TileFacts facts;
  const auto [lowest, highest] = std::minmax_element(tile.heights.begin(), tile.heights.end());
  facts.min_height = tile.quantum * *lowest - tile.sag - placed.steps[2];
  facts.max_height = tile.quantum * *highest + placed.steps[2];
  const globe::Globe::Sphere sphere = globe::Globe::sphere_around(positions);
  facts.sphere = {sphere.centre[0], sphere.centre[1], sphere.centre[2], sphere.radius};
  facts.horizon_point = ground.horizon_point(sphere.centre, positions);
  if (std::isnan(facts.horizon_point[0]))
    facts.horizon_point = globe::scaled(globe::normalized(sphere.centre), kFarOut);
  return facts;
}

}  // namespace

globe::Space lattice_steps(const PyramidPlan& plan, int z) {
  const PyramidLevel& level = plan.levels[static_cast<std::size_t>(z)];
  if (plan.grid.is_flat()) {
    const LocalRaster& raster = plan.grid.local;
    const double cells = std::ldexp(static_cast<double>(raster.side) / LocalRaster::kPlaces, -z);
    return {cells * raster.cell_x, cells * raster.cell_y, level.quantum};
  }
  const double side = plan.grid.tile_width(z, plan.ellipsoid.semi_major);
  // The factor leaves space for relief; larger tiles use float32.
  const double short_step = globe::power_of_two_above(1.1 * side / 65535),
               least_step = globe::power_of_two_above(side / 0x1p21);
  const double step = std::max(least_step, std::clamp(short_step, globe::power_of_two_below(level.max_error / 256),
                                                      globe::power_of_two_below(level.max_error / 32)));
  return {step, step, step};
}

double skirt_depth(const PyramidPlan& plan, int z) {
  const PyramidLevel& level = plan.levels[static_cast<std::size_t>(z)];
  return 5 * std::max(level.geometric_error, level.max_error);
}

double lattice_error(const PyramidPlan& plan, int z) {
  return plan.grid.is_flat() ? 0 : std::sqrt(3.0 / 4) * lattice_steps(plan, z)[0];
}

EarthTile place_on_earth(const TerrainTile& tile, const PyramidPlan& plan) {
  const globe::Ground ground(plan.grid, plan.ellipsoid);
  EarthTile placed;
  placed.steps = lattice_steps(plan, tile.id.z);
  // At the border of a local grid's raster, the mesh ends within the tile.
  const std::uint16_t east = *std::max_element(tile.u.begin(), tile.u.end()),
                      north = *std::max_element(tile.v.begin(), tile.v.end());
  placed.west = vertices_along(tile.u, 0, tile.v, Way::kUp);
  placed.north = vertices_along(tile.v, north, tile.u, Way::kUp);
  placed.east = vertices_along(tile.u, east, tile.v, Way::kDown);
  placed.south = vertices_along(tile.v, 0, tile.u, Way::kDown);

  std::vector<std::array<std::int64_t, 3>> points;
  const auto add_point = [&](std::size_t v, double below) {
    points.push_back(nearest_lattice_point(shared_position(tile, v, plan.grid, ground, below), placed.steps));
  };
  for (std::size_t v = 0; v < tile.u.size(); ++v) add_point(v, 0);
  struct Side {
    const std::vector<std::uint32_t>& vertices;
    int to_east, to_north;
  };
  const std::array sides{Side{placed.west, -1, 0}, Side{placed.north, 0, 1}, Side{placed.east, 1, 0},
                         Side{placed.south, 0, -1}};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    if (!has_tile_beside(plan.grid, tile.id, sides[side].to_east, sides[side].to_north)) continue;
    placed.feet[side].resize(sides[side].vertices.size());
    for (const std::uint32_t v : sides[side].vertices) add_point(v, skirt_depth(plan, tile.id.z));
  }

  placed.origin.fill(std::numeric_limits<std::int64_t>::max());
  for (const auto& point : points) {
    for (std::size_t k = 0; k < 3; ++k) placed.origin[k] = std::min(placed.origin[k], point[k]);
  }
  std::size_t next = 0;
  const auto take_offset = [&] {
    std::array<std::uint32_t, 3> offset{};
    for (std::size_t k = 0; k < 3; ++k) offset[k] = static_cast<std::uint32_t>(points[next][k] - placed.origin[k]);
    ++next;
    return offset;
  };
  placed.offsets.resize(tile.u.size());
  for (auto& offset : placed.offsets) offset = take_offset();
  for (auto& feet : placed.feet) {
    for (auto& foot : feet) foot = take_offset();
  }
  for (const auto& normal : tile.normals) placed.normals.push_back(globe::decode_octahedral(normal));
  const double units = tile.units;
  for (std::size_t v = 0; v < tile.u.size(); ++v)
    placed.places.push_back({tile.u[v] / units, (units - tile.v[v]) / units});
  placed.triangles = tile.triangles;
  placed.facts = find_facts(tile, placed, ground);
  return placed;
}

}  // namespace scarp::io
