// What a set says of itself: layer.json of quantized-mesh; tileset.json and subtrees of 3D Tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/tile_set.h"
#include "scarp/tiles3d.h"

namespace scarp {

/// Tiles of a level from x to end_x and from y to end_y.
struct ClaimedTiles {
  std::uint32_t x = 0, y = 0, end_x = 0, end_y = 0;
};

struct SetClaims {
  std::vector<std::string> faults;                ///< sentences: what is missing, cannot be read, or makes no sense
  std::vector<std::vector<ClaimedTiles>> levels;  ///< tiles that are announced
  bool announces_all = true;                      ///< false where tiles themselves announce others
  std::vector<std::optional<double>> node_errors, bounds, source_errors;  ///< by level, where Scarp wrote them
  bool has_water_mask = false;                                            ///< tiles have one
  std::optional<int> cells;
  std::optional<double> background;
  std::optional<Geodetic> ellipsoid;
  TileGrid grid = {};  ///< of the projection that layer.json names, or the one in tileset.json
  FactsByTile facts;   ///< of 3D Tiles
};

/// Believes nothing: claims that make no sense are among the faults.
SetClaims read_set_claims(const TileSetReader& set);

}  // namespace scarp
