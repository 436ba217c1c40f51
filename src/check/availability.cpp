#include "check/availability.h"

#include <fmt/format.h>

#include <algorithm>

namespace scarp::check {
namespace {

/// Limit of reported missing tiles, for a set that announces the whole globe but contains few tiles.
constexpr std::uint64_t kMostMissing = 100'000;

std::uint64_t key_of(std::uint32_t x, std::uint32_t y) { return std::uint64_t{y} << 32 | x; }

TileId id_of(std::size_t z, std::uint64_t key) {
  return {static_cast<int>(z), static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
}

}  // namespace

void check_availability(const TileSetReader& set, const io::SetClaims& claims, const TileGrid& grid,
                        std::vector<TileFault>& faults) {
  const auto add = [&](std::string sentence) { faults.push_back({TileFaultKind::kAvailability, std::move(sentence)}); };
  const auto name = [&](TileId id) { return tile_name(set.format(), id); };
  for (const std::string& fault : claims.faults) add(fault);
  const auto& levels = set.tiles();
  static const std::vector<std::uint64_t> kNone;
  const auto tiles_of = [&](std::size_t z) -> const std::vector<std::uint64_t>& {
    return z < levels.size() ? levels[z] : kNone;
  };
  std::uint64_t missing = 0;
  for (std::size_t z = 0; z < std::max(levels.size(), claims.levels.size()); ++z) {
    const std::vector<std::uint64_t>& tiles = tiles_of(z);
    std::vector<bool> is_announced(tiles.size());
    if (z < claims.levels.size()) {
      for (const io::ClaimedTiles& range : claims.levels[z]) {
        for (std::uint32_t y = range.y; y <= range.end_y && missing < kMostMissing; ++y) {
          auto tile = std::lower_bound(tiles.begin(), tiles.end(), key_of(range.x, y));
          std::uint64_t next = range.x;
          for (; next <= range.end_x && missing < kMostMissing; ++next) {
            const std::uint64_t key = key_of(static_cast<std::uint32_t>(next), y);
            if (tile != tiles.end() && *tile == key) {
              is_announced[static_cast<std::size_t>(tile - tiles.begin())] = true;
              ++tile;
            } else {
              ++missing;
              add(fmt::format("{} is announced, but missing", name(id_of(z, key))));
            }
          }
        }
      }
    }
    const std::vector<std::uint64_t>& parents = z > 0 ? tiles_of(z - 1) : kNone;
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const TileId id = id_of(z, tiles[k]);
      if (!is_announced[k] && claims.announces_all) add(fmt::format("{} is there, but not announced", name(id)));
      if (z > 0 && !std::binary_search(parents.begin(), parents.end(), key_of(id.x / 2, id.y / 2)))
        add(fmt::format("{} is there without its parent {}", name(id), name({id.z - 1, id.x / 2, id.y / 2})));
    }
  }
  for (std::uint32_t x = 0; x < grid.roots(); ++x) {
    const std::vector<std::uint64_t>& roots = tiles_of(0);
    if (!std::binary_search(roots.begin(), roots.end(), key_of(x, 0)))
      add(fmt::format("{} is missing: clients begin with the roots", name({0, x, 0})));
  }
}

}  // namespace scarp::check
