// The claims of a set about itself: layer.json of quantized-mesh; tileset.json and subtrees of 3D Tiles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/tiles3d.h"
#include "scarp/tile_set.h"

namespace scarp {

/// Tiles of a level from x to end_x and from y to end_y.
struct ClaimedTiles {
  std::uint32_t x = 0, y = 0, end_x = 0, end_y = 0;
};

/// A tile that tileset.json itself holds: implicit tiles follow from it, or it has none.
struct ClaimedRoot {
  std::string volume;           ///< "region" or "box"; empty without one that makes sense
  std::vector<double> numbers;  ///< numbers of the volume: 6 or 12
  std::string refine;           ///< its own; empty where it is its parent's
  std::optional<double> geometric_error;
  bool has_transform = false;
  std::vector<double> transform;  ///< 16; empty where it makes no sense
  bool is_implicit = false;
  std::optional<std::uint64_t> levels;  ///< implicit: that are available
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
  std::string vertical;                   ///< like LayerFacts::vertical, where Scarp wrote it
  std::string units;                      ///< like LayerFacts::units, where Scarp wrote them
  TileGrid grid = {};                     ///< grid of the projection that layer.json names, or the one in tileset.json
  FactsByTile facts;                      ///< facts of 3D Tiles
  std::optional<double> geometric_error;  ///< geometric error of tileset.json as a whole
  std::vector<ClaimedRoot> roots;         ///< roots of tileset.json, parents first
  std::optional<std::array<double, 2>> off_globe;  ///< offset of a local grid: metres along the ground, and in height
};

/// Believes nothing: claims that make no sense are among the faults.
SetClaims read_set_claims(const TileSetReader& set);

}  // namespace scarp
