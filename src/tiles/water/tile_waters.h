// Lakes and rivers in pyramids of tiles. Polygons, lines and water levels, which are determined before any tile is
// made, define the water nodes of the finest lattice. So every node depends only on its place, and a lake is the same
// on both sides of a border of tiles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp::tiles {

/// Places are fractional columns and rows of nodes of the finest lattice, counted as in NodeWindow from the grid's
/// north-western corner. Columns may exceed a turn.
struct TileLake {
  std::string name;
  double level = 0;  ///< metres above the zero of heights; NaN: its shore has no heights, and nodes do not change
  std::vector<std::vector<std::array<double, 2>>> rings;  ///< closed, with the even-odd rule
};

struct TileRiver {
  std::string name;
  std::vector<std::array<double, 3>> course;  ///< heights are above the zero of heights, NaN outside the source
};

}  // namespace scarp::tiles

namespace scarp {

struct TileWaters {
  std::vector<tiles::TileLake> lakes;  ///< a node in several lakes belongs to the last
  std::vector<tiles::TileRiver> rivers;
  DegreeBox covered = {};     ///< cover of the source: nodes outside have no heights
  TileGrid grid = {};         ///< grid of the lattice
  std::int64_t per_turn = 0;  ///< nodes of the lattice per turn: NodeWindow::per_turn
};

}  // namespace scarp

namespace scarp::tiles {

/// The sources of water. Coordinates of lines are degrees.
struct WaterLines {
  std::vector<Line> lakes;   ///< polygons; other lines are ignored
  std::vector<Line> rivers;  ///< open lines; others are ignored
  double percentile = 5;     ///< like WaterOptions::percentile
};

/// Computes levels of lakes and profiles of rivers on the plan's finest lattice, like find_lakes() and carve_rivers().
/// Levels are relative to `zero` (null: the ellipsoid), so water follows the geoid. Profiles differ from the exact ones
/// by at most half of the finest level's max error. `covered`: the cover of the source. A ring's edge that is longer
/// than half a turn follows the short way. Fails like the source, and with kUsage for a percentile out of range, a
/// polygon around a pole, and more nodes in a row than lines can count. Cost: reads the nodes along shores and rivers.
Result<TileWaters> find_tile_waters(const PyramidPlan& plan, const NodeSource& nodes,
                                    const std::shared_ptr<const HeightZero>& zero, const DegreeBox& covered,
                                    const WaterLines& lines);

/// The nodes of `source` with water. Nodes in a lake have its level; their eight neighbours outside lakes lie at least
/// a centimetre above it. The nodes nearest to a river have its height, except in lakes. Nodes without heights and
/// poles do not change. Samples between four nodes of one lake have its level; samples between four nodes of which only
/// some have water are omitted. Borrows the source. Reading fails with kUsage for a window of another grid, or if its
/// nodes per turn are not waters.per_turn or a half, a third, … of it. Memory: 12 bytes for each row of a lake's nodes
/// and each node of a river that was read.
std::unique_ptr<NodeSource> make_watered_source(const NodeSource& source, std::shared_ptr<const TileWaters> waters,
                                                std::shared_ptr<const HeightZero> zero);

/// Draws water masks of tiles for quantized-mesh. Borrows the waters.
class WaterMasks {
 public:
  explicit WaterMasks(const TileWaters& waters);
  /// 256 rows of 256 texels from the north, equally spaced in degrees: 255 times the share of 4 × 4 places in a texel
  /// that lie in a lake. A single byte if all texels are equal. Masks show the polygons on each level, including lakes
  /// without a water level. Depends only on the arguments.
  std::vector<std::uint8_t> draw(TileId id) const;
  /// A hash of the lakes that may reach into the tile or its descendants; 0 if none.
  std::uint64_t hash(TileId id) const;

 private:
  struct Box {
    double west, east, north, south;
  };
  /// Calls use(lake, shift in columns).
  template <class Use>
  void each_lake(TileId id, const Use& use) const;

  const TileWaters* waters_;
  std::vector<Box> boxes_;
};

}  // namespace scarp::tiles

#pragma GCC visibility pop
