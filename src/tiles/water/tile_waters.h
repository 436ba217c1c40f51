// Lakes and rivers in pyramids of tiles. Water is put onto the nodes of the finest lattice, from its polygons and lines
// and from levels that are found once, before any tile is made. So a node with water is a function of its place alone,
// as one without is, and tiles agree about a lake wherever it crosses their borders.
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

namespace scarp {

/// Places are fractional columns and rows of nodes of the finest lattice, counted as in NodeWindow from the western and
/// northern end of the grid. Columns may lie beyond a turn.
struct TileLake {
  std::string name;
  double level = 0;  ///< metres above the zero of heights; NaN: its shore has no heights, and no node changes
  std::vector<std::vector<std::array<double, 2>>> rings;  ///< closed; what lies in an odd number of them is water
};

struct TileRiver {
  std::string name;
  std::vector<std::array<double, 3>> course;  ///< with heights above the zero of heights, NaN outside the source
};

struct TileWaters {
  std::vector<TileLake> lakes;  ///< a node in several belongs to the last
  std::vector<TileRiver> rivers;
  DegreeBox covered = {};     ///< by the source: nodes beyond have no heights
  TileGrid grid = {};         ///< grid of the lattice
  std::int64_t per_turn = 0;  ///< nodes of the lattice per turn: NodeWindow::per_turn
};

/// The sources of water. Coordinates of lines are degrees.
struct WaterLines {
  std::vector<Line> lakes;   ///< polygons; other lines do not count
  std::vector<Line> rivers;  ///< open lines; others do not count
  double percentile = 5;     ///< like WaterOptions::percentile
};

/// Levels of lakes and profiles of rivers on the finest lattice of the plan, as find_lakes() and carve_rivers() have
/// them. They are above `zero`, null for the ellipsoid: so water follows the geoid. Profiles are within half of the
/// finest level's max error of the exact ones. `covered`: by the source. Rings follow the short way where an edge is
/// longer than half a turn. Fails with kUsage for a percentile out of range, for a polygon around a pole, and for more
/// nodes side by side than lines can count; as the source does. Cost: of the nodes those along shores and rivers are
/// read.
Result<TileWaters> find_tile_waters(const PyramidPlan& plan, const NodeSource& nodes,
                                    const std::shared_ptr<const HeightZero>& zero, const DegreeBox& covered,
                                    const WaterLines& lines);

/// The nodes of `source` with the water in them. Nodes in a lake have its level. The eight around each that are in no
/// lake lie at least a centimetre above it. The nodes nearest to a river have its height, but those of lakes. Nodes
/// without a height stay so, and so do poles. Samples at a place between four nodes of one lake have its level; those
/// between nodes of which some have water are none. Borrows the source. Reading fails with kUsage for a window of
/// another grid, or of other nodes than waters.per_turn or a half, a third, … of them. Memory: 12 bytes for each row of
/// nodes of a lake, and for each node of a river, that was read.
std::unique_ptr<NodeSource> make_watered_source(const NodeSource& source, std::shared_ptr<const TileWaters> waters,
                                                std::shared_ptr<const HeightZero> zero);

/// Draws water masks of tiles, as quantized-mesh has them. Borrows the waters.
class WaterMasks {
 public:
  explicit WaterMasks(const TileWaters& waters);
  /// 256 rows of 256 texels from the north, evenly apart in degrees: 255 times the share of 4 × 4 places in a texel
  /// that lie in a lake. One byte where all are the same. It shows the polygons on each level, also lakes without a
  /// level. A function of its arguments.
  std::vector<std::uint8_t> draw(TileId id) const;
  /// A hash of the lakes that may reach into the tile or those below it; 0 for none.
  std::uint64_t hash(TileId id) const;

 private:
  struct Box {
    double west, east, north, south;
  };
  /// Calls use(lake, columns by which it is shifted).
  template <class Use>
  void each_lake(TileId id, const Use& use) const;

  const TileWaters* waters_;
  std::vector<Box> boxes_;  ///< boxes of the lakes
};

}  // namespace scarp

#pragma GCC visibility pop
