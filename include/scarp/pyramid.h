// The values that pyramids of tiles are made of: the plan, a tile, what is known of the tiles that were made.
//
// HEIGHTS are multiples of a quantum that a level shares, and a tile's header is chosen so that clients decode a height
// to the same float32 in each tile.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/quality.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"

#pragma GCC visibility push(default)

namespace scarp {

class TileLines;
struct TileWaters;

/// The goals of a pyramid.
struct PyramidSettings {
  /// Nodes' cells a side of tiles of the finest level, a power of two, 16 … 256. DEFAULT: 128.
  int cells = 128;
  /// Levels 0 … max_zoom. DEFAULT (−1): the first level whose nodes are no farther apart than 1.1 cells of the source.
  int max_zoom = -1;
  /// Metres, of the finest level; above 0. DEFAULT (0): a quarter of its geometric error, or what the
  /// format holds for such heights if that is more.
  double max_error = 0;
  /// A level's max error is the geometric error over this, or max_error if that is more. At least 1/2. DEFAULT: 2.
  double quality = 2;
  /// DEFAULT: kNormal.
  Effort effort = Effort::kNormal;
  /// Height of nodes without a height, metres. DEFAULT: 0, the ellipsoid.
  float background = 0;
  /// True if each tile with a child has all four, also those without a height: clients of 3D Tiles show a hole where
  /// one is missing, those of quantized-mesh cut it out of its parent. DEFAULT: false.
  bool has_siblings = false;
  Geodetic ellipsoid = {};
  TileGrid grid = {};  ///< DEFAULT: geographic.
  /// Blocks that do not touch it are treated as places without heights. The others' tiles are those of the whole
  /// pyramid. DEFAULT: all.
  std::optional<DegreeBox> only = {};
  /// Largest size of a tile, as it is kept. Where a tile has more, the max error of its interior is doubled until it
  /// fits, or until only its border remains; the border stays. DEFAULT: 0, any.
  std::uint64_t max_tile_bytes = 0;
  /// True if the source's samples, each at its own place, are bound as nodes are. The finest level is then that of half
  /// the cells: nodes are half as far apart as they need be, since samples far from the land between nodes cannot be
  /// reached. REQUIRES then: a source that has_samples(). DEFAULT: false.
  bool binds_samples = false;
  /// Edges of all tiles' meshes. DEFAULT: none.
  std::vector<DegreeLine> lines = {};
};

/// A level of a pyramid.
struct PyramidLevel {
  double geometric_error = 0;  ///< metres
  double max_error = 0;        ///< max error of the tiles' meshes at their nodes, metres
  double quantum = 0;          ///< heights are multiples of this power of two, metres
  int segments = 1;            ///< edges of triangles span at most 1/segments of a tile, for the earth's curvature
};

/// A source of a stack, as the plan knows it.
struct PlannedSource {
  DegreeBox covered = {};
  int max_zoom = 0;  ///< the finest level that it asks for
};

/// The settings, resolved: all that a tile depends on besides its nodes.
struct PyramidPlan {
  int cells = 128;
  int block_level =
      0;  ///< tiles of this level and below count all nodes; those above, nodes reduced to 256 cells a side
  std::vector<PyramidLevel> levels;  ///< 0 … the finest
  double least_quantum = 0;          ///< the finest that holds the source's heights; 0 in a plan that was read
  Effort effort = Effort::kNormal;
  float background = 0;
  bool has_siblings = false;  ///< like PyramidSettings::has_siblings
  std::uint64_t max_tile_bytes = 0;
  bool binds_samples = false;                        ///< like PyramidSettings::has_siblings
  std::shared_ptr<const TileLines> lines = nullptr;  ///< null: none
  Geodetic ellipsoid = {};
  TileGrid grid = {};
  DegreeBox covered = {};  ///< by the source
  /// Sources of a stack, else empty. Tiles below the block level are made only where a source asks for their level.
  std::vector<PlannedSource> sources = {};
  /// Water of the nodes; null without water.
  std::shared_ptr<const TileWaters> waters = nullptr;
  /// True if tiles have masks of the lakes. REQUIRES then: waters; quantized-mesh. DEFAULT: false.
  bool has_water_mask = false;

  int max_zoom() const { return static_cast<int>(levels.size()) - 1; }
};

/// A tile's mesh, as clients decode it.
struct TerrainTile {
  TileId id;
  std::int32_t units = 32767;                        ///< a side of the tile, as TileGrid::side_units()
  std::vector<std::uint16_t> u, v;                   ///< 0 … units from west, from south
  std::vector<std::int32_t> heights;                 ///< in quanta of the level
  std::vector<std::array<std::uint8_t, 2>> normals;  ///< octahedral, earth-centred or on the plane
  std::vector<std::uint32_t> triangles;              ///< counter-clockwise seen from above
  double quantum = 1;
  double max_error = 0;  ///< asked of its interior, metres: the level's, or more because of max_tile_bytes
  /// Straight pieces of lines that are no edges: rounded to 32767ths of the tile, they would turn triangles over.
  std::uint64_t lines_left_out = 0;

  /// Largest |mesh − node| over all nodes of the tile, of the heights as clients decode them, in metres, where edges
  /// are straight on the map. Above the plan's block level an upper bound.
  double node_error = 0;
  /// The most that flat triangles lie below the ellipsoid's curve, in metres: adds to node_error in space.
  double sag = 0;

  double bound() const { return node_error + sag; }

  /// Largest |mesh − sample| over the source's samples in the tile, each at its own place, as node_error else; above
  /// the plan's block level an upper bound. Samples next to a node without a height, where the mesh goes down to the
  /// background, do not count. NaN where it is not known: the source has no samples to show, or they were not examined.
  double source_error = std::numeric_limits<double>::quiet_NaN();
};

/// The bytes that are kept of a tile. Several threads call it at once.
using TileEncoder = std::function<Result<std::vector<std::uint8_t>>(const TerrainTile&)>;

struct KeptTile {
  TerrainTile tile;
  std::vector<std::uint8_t> bytes;
};

/// The destination of a pyramid's tiles.
class TileSink {
 public:
  virtual ~TileSink() = default;
  /// The bytes to keep. Several threads call it at once.
  virtual Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const = 0;
  /// Called in the same order for any number of threads, by one thread at a time.
  virtual Result<void> put(TileId id, std::span<const std::uint8_t> bytes) = 0;
};

/// Statistics about the tiles of a level.
struct LevelSummary {
  std::uint64_t tiles = 0, triangles = 0, bytes = 0;
  double node_error = 0, bound = 0;  ///< the largest of its tiles
  double source_error = 0;           ///< the same; NaN where one of them is
  /// Tiles whose node_error, or source_error if the plan binds samples, is above their max error: those with cliffs
  /// that rounded positions cannot follow, with samples that nodes cannot, and above the block level those whose
  /// reduced nodes allow no smaller proven error.
  std::uint64_t over = 0;
  std::uint64_t coarser = 0;         ///< tiles whose max error is above the level's because of plan.max_tile_bytes
  std::uint64_t oversized = 0;       ///< number of these that have more bytes all the same: their borders alone do
  std::uint64_t lines_left_out = 0;  ///< sum of TerrainTile::lines_left_out
};

struct PyramidReport {
  bool has_heights = false;                       ///< some node has one
  std::vector<LevelSummary> levels;               ///< 0 … the finest
  std::vector<std::vector<std::uint64_t>> tiles;  ///< by level: rows and columns of its tiles, y · 2^32 + x, sorted
};

/// The facts about a block that was made.
struct BlockReport {
  TileId block;
  PyramidReport report;
  /// For finish_pyramid(): its nodes reduced to 128 cells a side, and bounds of what the reduction lost, 390 kB. The
  /// same bytes on every machine. Empty for a block without heights.
  std::vector<std::uint8_t> reduced;
  std::uint64_t hash = 0;  ///< result of hash_block()
  /// Cost of making it: CPU time, and the most memory that the process had until then. Set by whoever measures it.
  double core_seconds = 0;
  std::uint64_t memory = 0;
};

}  // namespace scarp

#pragma GCC visibility pop
