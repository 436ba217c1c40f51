// The metadata of a tile set: layer.json of quantized-mesh; tileset.json and subtrees of 3D Tiles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/tiles3d.h"
#include "scarp/tile_set.h"

namespace scarp::io {

/// Tiles of a level from x to end_x and from y to end_y.
struct ClaimedTiles {
  std::uint32_t x = 0, y = 0, end_x = 0, end_y = 0;
};

/// A tile listed in tileset.json itself; may be the root of implicit tiles.
struct ClaimedRoot {
  std::string volume;           ///< "region" or "box"; empty if absent or invalid
  std::vector<double> numbers;  ///< numbers of the volume: 6 or 12
  std::string refine;           ///< its own refinement; empty if inherited
  std::optional<double> geometric_error;
  bool has_transform = false;
  std::vector<double> transform;  ///< 16; empty if invalid
  bool is_implicit = false;
  std::optional<std::uint64_t> levels;  ///< the available levels, if implicit
};

struct SetClaims {
  std::vector<std::string> faults;                ///< sentences on missing, unreadable or invalid contents
  std::vector<std::vector<ClaimedTiles>> levels;  ///< announced tiles
  bool announces_all = true;                      ///< false if tiles announce further tiles
  std::vector<std::optional<double>> node_errors, bounds, source_errors;  ///< by level, in Scarp's sets
  bool has_water_mask = false;                                            ///< tiles have one
  std::optional<int> cells;
  std::optional<double> background;
  std::optional<Geodetic> ellipsoid;
  std::string vertical;                   ///< like LayerFacts::vertical, in Scarp's sets
  std::string units;                      ///< like LayerFacts::units, in Scarp's sets
  TileGrid grid = {};                     ///< grid of the projection named by layer.json, or the one in tileset.json
  FactsByTile facts;                      ///< facts of 3D Tiles
  std::optional<double> geometric_error;  ///< geometric error of tileset.json as a whole
  std::vector<ClaimedRoot> roots;         ///< roots of tileset.json, parents first
  std::optional<std::array<double, 2>> off_globe;  ///< largest error of a local grid on the ground, and in height
};

/// Handles hostile files: invalid claims become faults.
SetClaims read_set_claims(const TileSetReader& set);

}  // namespace scarp::io
