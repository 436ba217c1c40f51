// Checks of finished sets of tiles, Scarp's or another program's: what clients will decode is compared with what the
// set declares about itself, tile with tile, and with the nodes that it was made of.
//
//   container     statements of the container's own header, index and tables are true
//   availability  each tile that is announced is there, each that is there is announced, with its parent; so are the
//                 roots
//   file          each tile can be decoded, all its indices are those of vertices
//   coverage      triangles cover the tile once: none is turned over, no gap, no vertex in the middle of an edge
//   edge list     the lists of the four edges name all vertices there, and no others
//   border        neighbours decode to the same vertices, heights in single precision, and normals, at the four tiles
//                 of a corner, around the antimeridian and at the poles, too
//   header        heights, bounding sphere and centre hold all vertices
//   horizon       no camera sees a vertex of a tile that its horizon point hides from it
//   bound         no node under a tile is farther from its triangles than the set promises of the level; no sample of
//                 the source either
//   tileset       statements of tileset.json about its roots: volumes, transform, refinement, errors, levels; with
//                 nodes, too, that a local grid lies where its source does
//
// Nothing here knows how tiles are made: the room src/check may not include src/tiles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/nodes.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile_grid.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

enum class TileFaultKind {
  kContainer,
  kAvailability,
  kFile,
  kCoverage,
  kEdgeList,
  kBorder,
  kHeader,
  kHorizon,
  kBound,
  kTileset
};
inline constexpr std::size_t kTileFaultKinds = 10;
/// "container", "edge list", …
const char* name_of(TileFaultKind kind);

/// The position of a local grid's raster on the globe.
struct CheckedPlace {
  /// Longitude and latitude in degrees, and the metres above the ellipsoid that its heights count from, of a place in
  /// cells east and north of the south-western sample; not finite where it has none.
  std::function<std::array<double, 3>(double east, double north)> find;
  Geodetic ellipsoid = {};
};

/// The nodes that a set was made of.
struct CheckedNodes {
  const NodeSource* source = nullptr;     ///< heights above the ellipsoid; borrowed
  DegreeBox covered{-180, -90, 180, 90};  ///< beyond it no node has a height
  /// Cells a side of a tile of the set's finest level. DEFAULT (0): the number in the set's metadata, else 128.
  int cells = 0;
  /// Height of nodes without a height. DEFAULT: the height in the set's metadata, else 0.
  std::optional<float> background = std::nullopt;
  /// DEFAULT: none, the raster has no place on the globe.
  std::optional<CheckedPlace> place = std::nullopt;
};

struct TileCheckOptions {
  CheckedNodes nodes = {};  ///< DEFAULT: none, bounds are not measured
  /// Ellipsoid of the globe. DEFAULT: the one in the set's metadata, else WGS 84.
  std::optional<Geodetic> ellipsoid = std::nullopt;
  std::optional<TileGrid> grid = std::nullopt;  ///< DEFAULT: of the projection that layer.json names, else geographic.
  std::size_t most_faults = 1;                  ///< number of faults described, of each kind
  Run run = {};                                 ///< threads and progress, passes "check" and "nodes"
};

struct TileFault {
  TileFaultKind kind = TileFaultKind::kContainer;
  std::string sentence;  ///< names the tile
};

/// The findings on a level.
struct CheckedLevel {
  std::uint64_t tiles = 0, triangles = 0;
  std::uint64_t edges = 0, edges_apart = 0;      ///< number of edges that two tiles share, or a pole; number of them
                                                 ///< that differ
  std::uint64_t corners = 0, corners_apart = 0;  ///< number of corners that tiles share across, likewise
  double gap = 0;                                ///< the largest between two edges, metres
  double sag = 0;                                ///< depth of the flat triangles below the curve, metres
  std::optional<double> promised_node_error, promised_bound, promised_source_error;  ///< values that the set itself
                                                                                     ///< declares
  /// With nodes: the largest |mesh − node| where edges are straight on the map, and the largest distance in space.
  std::optional<double> node_error, distance;
  /// With nodes whose source shows its samples: the largest |mesh − sample|, each at its own place, of those that all
  /// four nodes around have heights.
  std::optional<double> source_error;
};

struct TileCheck {
  TileFormat format = TileFormat::kQuantizedMesh;
  std::string units;                 ///< units of a local grid's cells, like LayerFacts::units: lengths here are in
                                     ///< these
  std::vector<CheckedLevel> levels;  ///< 0 … the finest
  std::array<std::uint64_t, kTileFaultKinds> faults{};  ///< by kind
  std::vector<TileFault> described;                     ///< in the order of the kinds
  std::uint64_t nodes = 0;                              ///< places where a tile was compared with a node

  std::uint64_t count() const;
  bool holds() const { return count() == 0; }
};

/// Checks all of a set. The result does not depend on the number of threads. Fails with kCancelled, as the nodes'
/// source does, and with kUsage for cells that make no lattice of the set's levels; faults of the set are in the
/// result.
///
/// Memory: that of the reader, edges of a row of tiles (some 2 kB a tile), 200 bytes a tile for 3D Tiles, and with
/// nodes 70 MB. Cost: each tile is decoded once, with nodes twice; each node is read once, and judged on each level, as
/// are the samples.
Result<TileCheck> check_tiles(const TileSetReader& set, const TileCheckOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
