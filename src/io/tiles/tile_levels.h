// The tiles in a set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scarp/tile.h"

namespace scarp::io {

/// The rows and columns of tiles by level, as y · 2^32 + x. Sorted by sort().
class TileLevels {
 public:
  /// REQUIRES: the grid has the tile.
  void add(TileId id) {
    const auto z = static_cast<std::size_t>(id.z);
    if (levels_.size() <= z) levels_.resize(z + 1);
    levels_[z].push_back(key(id));
    ++count_;
  }
  /// False if a tile occurs twice.
  bool sort() {
    for (auto& level : levels_) {
      std::sort(level.begin(), level.end());
      if (std::adjacent_find(level.begin(), level.end()) != level.end()) return false;
    }
    return true;
  }
  bool has(TileId id) const {
    if (id.z < 0 || static_cast<std::size_t>(id.z) >= levels_.size()) return false;
    const auto& level = levels_[static_cast<std::size_t>(id.z)];
    return std::binary_search(level.begin(), level.end(), key(id));
  }
  std::uint64_t count() const { return count_; }
  const std::vector<std::vector<std::uint64_t>>& levels() const { return levels_; }

 private:
  static std::uint64_t key(TileId id) { return std::uint64_t{id.y} << 32 | id.x; }

  std::vector<std::vector<std::uint64_t>> levels_;
  std::uint64_t count_ = 0;
};

/// True if a geographic grid has the tile.
inline bool is_of_grid(TileId id) {
  return id.z >= 0 && id.z <= kMaxTileLevel && id.y >> id.z == 0 && id.x >> id.z < 2;
}

}  // namespace scarp::io
