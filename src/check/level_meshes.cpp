#include "check/level_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "check/availability.h"
#include "check/client_tile.h"
#include "io/tiles/set_claims.h"

namespace scarp::check {
namespace {

constexpr double kWidest = 4;

struct LevelTiles {
  std::vector<TileId> ids;
  DegreeBox box{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  double width() const { return box.east - box.west; }
  double height() const { return box.north - box.south; }
};

/// Tiles that overlap `place`; all if null.
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

/// Conversion from degrees to metres around a place.
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

/// The smallest power of two for which `extent` is at most 65,534 such steps: rounding to them keeps differences within
/// 16 bits.
double find_step(double extent) {
  constexpr double kMostSteps = 65534;
  if (extent == 0) return 1;
  int exponent = 0;
  const double share = std::frexp(extent / kMostSteps, &exponent);  // 1/2 to below 1
  return std::ldexp(1.0, share == 0.5 ? exponent - 1 : exponent);
}

/// Places the tiles of a level on a map.
class Laying {
 public:
  Laying(const FlatMap& map, int z) : map_(map), z_(z) {}

  void add(ClientTile tile) {
    std::vector<Place> places;
    for (std::size_t v = 0; v < tile.u.size(); ++v) places.push_back(place_of(tile, v));
    // One step of a tile's positions. It exceeds the rounding of a vertex and is less than the width of the map.
    const double near = (tile.box.east - tile.box.west) * map_.metres_east / kWholeTile;
    for (const auto& edge : tile.edges) {
      for (const std::uint32_t v : edge) {
        // The key that neighbours decode identically: positions in space, or degrees.
        const Place key = tile.format == TileFormat::kGlb ? tile.places[v] : Place{places[v][0], places[v][1], 0};
        const Place& known = shared_.try_emplace(key, places[v]).first->second;
        if (length(known - places[v]) < near) places[v] = known;
      }
    }
    LevelTile laid{{}, std::move(tile.image)};
    laid.mesh.metadata = {{"crs_option", "local"}, {"unit", "m"}, {"tile_level", fmt::format("{}", z_)}};
    for (const Place& place : places) laid.mesh.positions.insert(laid.mesh.positions.end(), place.begin(), place.end());
    laid.mesh.triangles = std::move(tile.triangles);
    laid.mesh.uvs = std::move(tile.uvs);
    tiles_.push_back(std::move(laid));
  }

  /// Rounds all tiles to the same steps, so that neighbours still meet.
  LevelMesh take() {
    Place extents{};
    for (const LevelTile& tile : tiles_) {
      for (std::size_t k = 0; k < 3; ++k) extents[k] = std::max(extents[k], extent_of(tile.mesh, k));
    }
    const Place steps{find_step(extents[0]), find_step(extents[1]), find_step(extents[2])};
    for (LevelTile& tile : tiles_) {
      auto& positions = tile.mesh.positions;
      for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = std::nearbyint(positions[i] / steps[i % 3]) * steps[i % 3];
    }
    std::stable_partition(tiles_.begin(), tiles_.end(), [](const LevelTile& tile) { return tile.image.bytes.empty(); });
    return {z_, std::move(tiles_), {steps[0], steps[1]}};
  }

 private:
  Place place_of(const ClientTile& tile, std::size_t v) const {
    const Geographic at = geographic_at(tile.box, tile.u[v], tile.v[v], tile.heights[v]);
    return {(at.longitude - map_.longitude) * map_.metres_east, (at.latitude - map_.latitude) * map_.metres_north,
            at.height};
  }

  static double extent_of(const Mesh& mesh, std::size_t axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = axis; i < mesh.positions.size(); i += 3) {
      low = std::min(low, mesh.positions[i]);
      high = std::max(high, mesh.positions[i]);
    }
    return high - low;
  }

  const FlatMap& map_;
  int z_;
  std::vector<LevelTile> tiles_;
  std::map<Place, Place> shared_;  ///< positions of vertices on edges
};

/// The tiles as stored; nothing if they have more than `most_bytes`.
Result<std::optional<std::vector<std::vector<std::uint8_t>>>> read_tiles(const TileSetReader& set,
                                                                         const std::vector<TileId>& ids,
                                                                         std::uint64_t most_bytes) {
  std::vector<std::vector<std::uint8_t>> tiles;
  for (const TileId id : ids) {
    SCARP_TRY(auto&& tile, set.read_tile(id));
    if (tile.size() > most_bytes) return std::nullopt;
    most_bytes -= tile.size();
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

}  // namespace

Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes) {
  const io::SetClaims claims = io::read_set_claims(set);
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
    SCARP_TRY(const auto& kept, read_tiles(set, tiles.ids, most_bytes - bytes));
    if (!kept && levels.empty()) continue;
    if (!kept) break;
    Laying laying(map, static_cast<int>(z));
    std::uint64_t level_bytes = 0;
    for (std::size_t k = 0; k < tiles.ids.size(); ++k) {
      level_bytes += (*kept)[k].size();
      SCARP_TRY(auto&& tile, decode_client_tile(set.format(), (*kept)[k], tiles.ids[k], claims.grid, world, nullptr));
      laying.add(std::move(tile));
    }
    bytes += level_bytes;
    levels.push_back(laying.take());
    levels.back().tile_bytes = level_bytes;
  }
  if (levels.empty())
    return fail(ErrorKind::kUsage, fmt::format("the tiles of each level take more than {} bytes", most_bytes));
  return levels;
}

std::vector<std::string> find_set_faults(const TileSetReader& set) {
  const io::SetClaims claims = io::read_set_claims(set);
  std::vector<TileFault> faults;
  check_availability(set, claims, claims.grid, faults);
  std::vector<std::string> sentences;
  for (TileFault& fault : faults) sentences.push_back(std::move(fault.sentence));
  return sentences;
}

}  // namespace scarp::check
