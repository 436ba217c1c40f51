#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "check/client_tile.h"
#include "io/tiles/set_claims.h"
#include "scarp/tile_set_mesh.h"

namespace scarp {
namespace {

constexpr double kWidest = 4;

struct LevelTiles {
  std::vector<TileId> ids;
  DegreeBox box{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  double width() const { return box.east - box.west; }
  double height() const { return box.north - box.south; }
};

/// Those with some of `place`; all without it.
LevelTiles find_tiles(const TileSetReader& set, const TileGrid& grid, std::size_t z, const DegreeBox* place) {
  LevelTiles level;
  for (const std::uint64_t key : set.tiles()[z]) {
    const TileId id{static_cast<int>(z), static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
    const DegreeBox box = grid.bounds_of(id);
    const bool meets = place == nullptr || (box.west < place->east && box.east > place->west &&
                                            box.south < place->north && box.north > place->south);
    if (!meets) continue;
    level.ids.push_back(id);
    level.box = {std::min(level.box.west, box.west), std::min(level.box.south, box.south),
                 std::max(level.box.east, box.east), std::max(level.box.north, box.north)};
  }
  return level;
}

/// From degrees to metres around a place.
struct FlatMap {
  FlatMap(const World& world, const DegreeBox& box)
      : longitude((box.west + box.east) / 2), latitude((box.south + box.north) / 2) {
    constexpr double kStep = 1e-3;
    const auto degree = [&](double east, double north) {
      return length(world.place({longitude + east, latitude + north, 0}) -
                    world.place({longitude - east, latitude - north, 0})) /
             (2 * kStep);
    };
    metres_east = degree(kStep, 0);
    metres_north = degree(0, kStep);
  }

  double longitude, latitude, metres_east = 0, metres_north = 0;
};

void add(const ClientTile& tile, const FlatMap& map, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::size_t v = 0; v < tile.u.size(); ++v) {
    const Geographic at = geographic_at(tile.box, tile.u[v], tile.v[v], tile.heights[v]);
    mesh.positions.insert(mesh.positions.end(), {(at.longitude - map.longitude) * map.metres_east,
                                                 (at.latitude - map.latitude) * map.metres_north, at.height});
  }
  for (const std::uint32_t v : tile.triangles) mesh.triangles.push_back(first + v);
}

}  // namespace

Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes) {
  const SetClaims claims = read_set_claims(set);
  const World world(claims.grid, claims.ellipsoid.value_or(Geodetic{}));
  std::size_t finest = set.tiles().size();
  while (finest > 0 && set.tiles()[finest - 1].empty()) --finest;
  if (finest == 0) return fail(ErrorKind::kInput, "the set has no tiles");
  const LevelTiles all = find_tiles(set, claims.grid, finest - 1, nullptr);
  const FlatMap map(world, all.box);
  std::vector<LevelMesh> levels;
  std::uint64_t bytes = 0;
  for (std::size_t z = finest; z-- > 0;) {
    const LevelTiles tiles = find_tiles(set, claims.grid, z, &all.box);
    if (tiles.ids.empty() || tiles.width() > kWidest * all.width() || tiles.height() > kWidest * all.height()) break;
    LevelMesh level{static_cast<int>(z), {}, 0};
    level.mesh.metadata = {{"crs_option", "local"}, {"unit", "m"}, {"tile_level", fmt::format("{}", z)}};
    for (const TileId id : tiles.ids) {
      const auto kept = set.read_tile(id);
      if (!kept) return tl::unexpected(kept.error());
      level.tile_bytes += kept->size();
      bytes += kept->size();
      if (bytes > most_bytes)
        return fail(ErrorKind::kUsage, fmt::format("its tiles take more than {} bytes", most_bytes));
      const auto tile = decode_client_tile(set.format(), *kept, id, claims.grid, world, nullptr);
      if (!tile) return tl::unexpected(tile.error());
      add(*tile, map, level.mesh);
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace scarp
