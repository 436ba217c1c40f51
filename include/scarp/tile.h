// Plan a pyramid of terrain tiles on the globe and make its tiles, as meshes and as bytes of quantized-mesh. For sets
// of tiles, made of raster files, see tile_job.h.
//
// The grid (TileGrid) lists the tiles. A tile is a function of (its id, the plan, the heights of its nodes and a few
// nodes around it). No neighbour enters it, so tiles may be made in any order, on any machine; two neighbours still
// have the same vertices, heights and normals on the edge that they share.
//
// NODES. The source is sampled on a lattice: `cells` cells a side for tiles of the finest level. Coarser tiles use all
// nodes below them, down to the plan's level of blocks. The max error of a tile counts all of them.
//
// A LOCAL GRID lies on a plane, its nodes are the samples of one raster, and tiles end where that does. All terms for
// the earth's curve are 0 there.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif", {.crs = "source"}));  // in degrees
//     SCARP_TRY(const auto& box, scarp::degrees_covered(dem, dem.frame.affine, nullptr));
//     const scarp::SourceFacts facts{.covered = box, .cell = 80, .min = dem.info.min, .max = dem.info.max};
//     SCARP_TRY(const auto& plan, scarp::plan_pyramid(facts, {.cells = 16}));
//     SCARP_TRY(const auto& nodes, scarp::make_node_source(dem, {.affine = dem.frame.affine}));
//     SCARP_TRY(const auto& tile, scarp::make_tile(plan, scarp::find_blocks(plan).front(), *nodes));
//     SCARP_RETURN_IF_ERROR(scarp::write_file("block.terrain", scarp::encode_quantized_mesh(tile)));
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

// Grids of tiles: which tiles each level has, and where they and the nodes between them lie.
//
// All grids are quadtrees: a tile of level z + 1 is a quarter of one of level z; y counts from the south. Nodes divide
// a tile's sides into equal numbers of steps; each node of a level is one of the finer levels, too.
//
// Clients place vertices by the tile's bounds in degrees, linearly. So do nodes of the geographic grid lie, evenly;
// rows of the Mercator grid are evenly apart on its map, not in degrees.
//
// A local grid lies on a plane, over one raster, whose samples its nodes are. Degrees, longitude and latitude are in it
// cells of the raster, to the east and to the north of its south-western sample.

/// A tile of a grid.
struct TileId {
  int z = 0;
  std::uint32_t x = 0, y = 0;  ///< y from the south

  friend bool operator==(const TileId&, const TileId&) = default;
};

inline constexpr int kMaxTileLevel = 23;

/// Degrees.
struct DegreeBox {
  double west = 0, south = 0, east = 0, north = 0;
};

/// Longitudes and latitudes of a line's vertices. A step of more than 180° goes the other way round.
using DegreeLine = std::vector<std::array<double, 2>>;

enum class GridKind {
  kGeographic,  ///< TMS in degrees: two tiles of 180° at level 0, side by side
  kMercator,    ///< TMS on the map of Web Mercator: one tile at level 0, which ends at ±85.0511°
  kLocal,       ///< one square on a plane at level 0, whose south-western corner is the raster's
};

/// The raster of a local grid.
struct LocalRaster {
  std::int32_t cols = 0, rows = 0;  ///< samples, at least 2 each
  double cell_x = 1, cell_y = 1;    ///< metres, or units of one's own; of 29 bits, so that places are exact
  std::int64_t side = 0;            ///< cells of the square: those of a tile of the finest level, times a power of two

  /// The sample that positions count from, next to the middle. Above 32768 samples one that all levels' positions are
  /// whole steps from.
  std::int64_t centre_col() const { return centre_of(cols); }
  std::int64_t centre_row() const { return centre_of(rows); }  ///< from the southern one

  friend bool operator==(const LocalRaster&, const LocalRaster&) = default;

  static constexpr std::int64_t kPlaces = 32768;  ///< number of positions of vertices on a side of a tile

 private:
  std::int64_t centre_of(std::int64_t samples) const {
    const std::int64_t step = side > kPlaces ? side / kPlaces : 1;
    return (samples - 1) / 2 / step * step;
  }
};

/// Nodes from one to another, both included.
struct NodeRange {
  std::int64_t first = 0, last = 0;
};

struct NodeWindow;

/// Whoever needs to know where a tile or a node lies asks its grid.
struct TileGrid {
  GridKind kind = GridKind::kGeographic;
  LocalRaster local = {};  ///< raster of a local grid

  /// The smallest grid that holds the raster. A tile of the finest level has `cells` cells a side. The sides of a cell
  /// are rounded to 29 bits.
  static TileGrid of_raster(std::int32_t cols, std::int32_t rows, double cell_x, double cell_y, int cells);

  bool is_flat() const { return kind == GridKind::kLocal; }
  /// The finest level of a local grid, whose nodes are the raster's samples.
  int finest_local(int cells) const;

  /// "geographic", "mercator", "local". find() knows nothing of a local grid but its kind.
  std::string_view name() const;
  static std::optional<TileGrid> find(std::string_view name);
  /// Its name in layer.json; "" for a local grid, which has none.
  std::string_view projection() const;
  static std::optional<TileGrid> find_projection(std::string_view projection);

  /// Tiles of level 0, side by side.
  std::uint32_t roots() const { return kind == GridKind::kGeographic ? 2 : 1; }
  std::uint32_t columns(int z) const { return roots() << z; }
  std::uint32_t rows(int z) const { return std::uint32_t{1} << z; }
  /// True for the grid's tiles; on a local grid false for tiles outside the raster.
  bool has(TileId id) const;
  /// Length of a tile's side in the units of u and v of its vertices. On local grids nodes are whole ones of these.
  std::int32_t side_units() const { return is_flat() ? static_cast<std::int32_t>(LocalRaster::kPlaces) : 32767; }

  /// Degrees to add to a tile's bounds for all its places that a source may cover: turns, where the last column of
  /// tiles is next to the first.
  std::span<const double> turns() const;
  /// True if the first and the last row of nodes are a pole each: one place.
  bool has_poles() const { return kind == GridKind::kGeographic; }
  /// True if rows of nodes are evenly apart in degrees.
  bool has_even_rows() const { return kind != GridKind::kMercator; }
  /// Nodes that have land: those of a local grid's raster, with those next beyond it where none is on its edge; of
  /// other grids all, also beyond a turn.
  NodeRange land_columns(std::int64_t per_turn) const;
  NodeRange land_rows(std::int64_t per_turn) const;

  DegreeBox bounds() const;
  DegreeBox bounds_of(TileId id) const;
  /// Degrees of a row of nodes, where rows count from 0, the northern end, to `last_row`, a power of two. The same bits
  /// on every machine.
  double latitude(std::int64_t row, std::int64_t last_row) const;
  /// Longitude of a column's nodes, −180 … 180, the same bits after each turn.
  double longitude(std::int64_t col, std::int64_t per_turn) const {
    if (is_flat()) return static_cast<double>(local.side) * (static_cast<double>(col) / static_cast<double>(per_turn));
    const std::int64_t wrapped = ((col % per_turn) + per_turn) % per_turn;
    return -180 + 360 * (static_cast<double>(wrapped) / static_cast<double>(per_turn));
  }
  /// From a row of nodes to the next, in degrees, over the same from a column to the next: at a latitude.
  double row_step(double latitude) const;
  /// Degrees between two nodes, the larger of both ways.
  double largest_step(std::int64_t per_turn) const {
    return (is_flat() ? static_cast<double>(local.side) : 360) / static_cast<double>(per_turn);
  }
  /// Nodes' steps from the western to the eastern end of the grid, for so many along a side of a tile of level z.
  std::int64_t per_turn(int z, std::int32_t steps) const { return (std::int64_t{steps} << z) * roots(); }
  /// Rows of nodes count from 0 to this.
  std::int64_t last_row(std::int64_t per_turn) const { return per_turn / roots(); }
  /// The nodes of a tile with so many steps a side, and `halo` more around it but for rows beyond the grid's ends.
  NodeWindow window_of(TileId id, std::int32_t steps, std::int32_t halo = 0) const;

  /// The error in metres that clients assume for a level of quantized-mesh: of an ellipsoid's `semi_major` axis, 65
  /// samples a tile (CesiumJS, cesium-native). The same share of a tile's side on a local grid.
  double geometric_error(int z, double semi_major = 6378137) const;
  /// Metres along a side of a tile, at most.
  double tile_width(int z, double semi_major) const;
};

/// A rectangle of nodes. Nodes divide the grid from west to east into `per_turn` steps.
struct NodeWindow {
  std::int64_t per_turn = 0;
  std::int64_t col = 0;  ///< from the western end; any number, for columns repeat after a turn
  std::int64_t row = 0;  ///< from the northern end, southwards; 0 … grid.last_row(per_turn)
  int cols = 0, rows = 0;
  TileGrid grid = {};

  std::int64_t last_row() const { return grid.last_row(per_turn); }
  /// True if a row is a pole: one place.
  bool is_pole(std::int64_t of_row) const { return grid.has_poles() && (of_row == 0 || of_row == last_row()); }
  /// Degrees of a column's nodes, −180 … 180, the same bits after each turn.
  double longitude(std::int64_t of_col) const { return grid.longitude(of_col, per_turn); }
  double latitude(std::int64_t of_row) const { return grid.latitude(of_row, last_row()); }
};

// Surfaces that heights are above, such as the sea, themselves above the ellipsoid.

/// The surface that heights are above, such as the sea: itself above the ellipsoid.
class HeightZero {
 public:
  virtual ~HeightZero() = default;
  /// Heights in metres above the ellipsoid at degrees, NaN where they are not known. Each depends on its place alone.
  /// Several threads may call it at once. The spans have equal sizes.
  virtual void find(std::span<const double> longitudes, std::span<const double> latitudes,
                    std::span<double> heights) const = 0;
};

/// The geoid EGM96 above the ellipsoid of WGS 84, built in: nodes 15 minutes of arc apart, in whole centimetres,
/// bilinear between them. Within 6 mm of what PROJ makes of the same grid (egm96_15.gtx), everywhere. The same bits on
/// every machine. Cost: 20 ms and 4 MB when it is asked for first.
std::shared_ptr<const HeightZero> egm96();

/// A grid of a surface's heights.
struct ZeroGrid {
  int cols = 0, rows = 0;      ///< at least 2
  std::vector<float> heights;  ///< cols · rows, row by row; metres above the ellipsoid, NaN where they are not known
  RasterPlace place;           ///< position of the grid's nodes
};

/// Bilinear between the four nodes around a place; up to half a cell outside as at the outer nodes. Not known where one
/// of the four is not. A grid in degrees that goes all round continues after its last column. Fails with kUsage for
/// other numbers of heights, and as make_node_source().
Result<std::shared_ptr<const HeightZero>> make_grid_zero(ZeroGrid grid);

// Heights by place: what tiles are made of.

/// Samples of a source side by side on a straight line, at equal steps of degrees; NaN where there is none.
struct SampleRow {
  double longitude = 0, latitude = 0;            ///< position of the first sample
  double step_longitude = 0, step_latitude = 0;  ///< to the next
  std::span<const float> heights;                ///< metres, as NodeSource::read() has them
};
using SampleVisitor = std::function<void(const SampleRow&)>;

/// Heights by place.
class NodeSource {
 public:
  virtual ~NodeSource() = default;
  /// Writes cols × rows heights in metres to `out`, the northern row first, NaN where there is none. A node's height is
  /// a function of its place alone. Several threads may call it at once. Fails as the samples' source does.
  virtual Result<void> read(const NodeWindow& window, std::span<float> out) const = 0;
  /// A part of the window outside which no node has a height; without columns or rows where none has. DEFAULT: all of
  /// it.
  virtual NodeWindow land(const NodeWindow& window) const { return window; }
  /// True if nodes are made of samples that visit_samples() shows. DEFAULT: false.
  virtual bool has_samples() const { return false; }
  /// Shows all samples that lie in the box, and others around it, some perhaps twice; longitudes continue beyond 180°
  /// where the box does. A row is valid during its visit. Several threads may call it at once. Fails as the samples'
  /// source does. DEFAULT: shows none.
  virtual Result<void> visit_samples(const DegreeBox& /*box*/, const SampleVisitor& /*visit*/) const { return {}; }
};

/// Nodes by interpolation between the samples of a raster: cubic (Catmull-Rom) where all 16 samples around a node are
/// heights, else bilinear between those of four that are. No height where the nearest sample has none. The raster's
/// place of a node is exact at each 16th node and interpolated between where `from_degrees` is given; so is the place
/// of a sample on the globe. Borrows the field's samples. Fails with kUsage for an affine map without an inverse.
Result<std::unique_ptr<NodeSource>> make_node_source(const HeightField& field, const RasterPlace& place);

/// The samples of the raster of a local grid, whose north is up: nodes of its finest level, or every second, fourth …
/// one. Beyond the raster its outermost samples are repeated: tiles read them, and end before. Borrows the field's
/// samples.
std::unique_ptr<NodeSource> make_local_nodes(const HeightField& field);

/// The nodes of `source`, raised by their zero's height, which is exact at most 1/32° apart and interpolated between.
/// Its read() fails with kInput for a height whose zero is not known. Borrows the source.
std::unique_ptr<NodeSource> make_raised_source(const NodeSource& source, std::shared_ptr<const HeightZero> zero);

/// A source of a stack.
struct StackedSource {
  const NodeSource* nodes = nullptr;  ///< borrowed
  DegreeBox covered = {};             ///< it has no heights elsewhere
};
/// Several sources as one: a node has the height of the first source with a height there. Only a single source shows
/// its samples. Cost: each source reads what those before it left open, as a rectangle.
std::unique_ptr<NodeSource> make_stacked_source(std::vector<StackedSource> sources);

/// Degrees that the raster covers, half a cell around the outer samples included. Fails with kInput where its outline
/// has no longitude or latitude, or lies beyond a pole or 720 degrees from Greenwich. `to_degrees`: from x and y to
/// degrees, null as in RasterPlace.
Result<DegreeBox> degrees_covered(const HeightField& field, const std::array<double, 6>& affine,
                                  const PointTransform* to_degrees);

// The values that pyramids of tiles are made of: the plan, a tile, what is known of the tiles that were made.
//
// HEIGHTS are multiples of a quantum that a level shares, and a tile's header is chosen so that clients decode a height
// to the same float32 in each tile.

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

// The bytes of quantized-mesh, a tile a file.

/// The bytes of a quantized-mesh 1.0 file, not compressed. With normals (extension 1), and with a water mask (extension
/// 2) that is not empty. Deterministic: no function of the machine's mathematics library is called.
std::vector<std::uint8_t> encode_quantized_mesh(const TerrainTile& tile, const Geodetic& ellipsoid = {},
                                                const TileGrid& grid = {},
                                                std::span<const std::uint8_t> water_mask = {});

/// A quantized-mesh file, as clients read it.
struct QuantizedMesh {
  std::array<double, 3> center{};
  float min_height = 0, max_height = 0;
  std::array<double, 4> sphere{};  ///< centre, radius
  std::array<double, 3> horizon_point{};
  std::vector<std::uint16_t> u, v, h;  ///< 0 … 32767
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> west, south, east, north;  ///< vertices on the edges
  std::vector<std::array<std::uint8_t, 2>> normals;     ///< empty, or one a vertex
  /// 0 land, 255 water; of all the tile, or 256 rows of 256 texels from the north. Empty without one; any other size is
  /// a fault of the file's.
  std::vector<std::uint8_t> water_mask;

  /// The height that clients decode: min + (max − min) · h / 32767.
  double height(std::size_t vertex) const {
    const double low = double{min_height}, high = double{max_height};
    return low + (high - low) * (static_cast<double>(h[vertex]) / 32767);
  }
};

/// Fails with kInput for what is no such file; never trusts a length or an index in it.
Result<QuantizedMesh> decode_quantized_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

/// The facts about the source that a plan needs.
struct SourceFacts {
  DegreeBox covered = {};
  double cell = 0;          ///< metres along the ground, the geometric mean of both ways, above 0
  double min = 0, max = 0;  ///< bounds of its heights, metres
  double cell_degrees = 0;  ///< like `cell`, for a raster in degrees; 0 for others
};

/// The conflicts among the settings, each a sentence: plan_pyramid() fails with kUsage and the first. Empty: none.
std::vector<std::string> list_conflicts(const PyramidSettings& settings);

/// Fails with kUsage for settings out of range.
Result<PyramidPlan> plan_pyramid(const SourceFacts& source, const PyramidSettings& settings = {});
/// Plans for a stack of at least one source: the finest level is that of the source that asks for the finest, and so
/// are the nodes everywhere.
Result<PyramidPlan> plan_pyramid(std::span<const SourceFacts> stack, const PyramidSettings& settings = {});

/// Gives the plan lines in place of those that it has; for its levels, and what is covered.
void set_lines(PyramidPlan& plan, std::vector<DegreeLine> lines);

/// The finest level that a source asks for in a tile, or so near that the tile's normals reach it; −1 where none has
/// heights there.
int finest_level(const PyramidPlan& plan, TileId id);

/// The tile as a set keeps it, within plan.max_tile_bytes where that can be: a function of (id, plan, nodes, encoder).
///
/// At plan.block_level and below, its node_error is at most its max error, but where positions in 32767ths of the tile
/// cannot follow the land, next to a cliff; its source_error too, if the plan binds samples, but where these are too
/// far from the land between the nodes around them.
///
/// Above plan.block_level it is made of the nodes that its mesh needs and no others: the mesh of finish_pyramid(), but
/// without its proof. node_error is NaN, since no nodes between these were examined. Cost: some 70,000 nodes, each read
/// alone where they are far apart.
///
/// REQUIRES: 0 <= id.z <= plan.max_zoom(). Fails as the source and the encoder do.
Result<KeptTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source, const TileEncoder& encode);
/// The tile, of as many bytes as it needs.
Result<TerrainTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source);

/// The tiles of make_pyramid(), without making one: by level, rows and columns, y · 2^32 + x, sorted. Reads each node
/// once; without a source no node, and then tiles below the blocks count as soon as the plan's source may cover them.
/// Progress: pass "look". Fails as the source does, and with kCancelled.
Result<std::vector<std::vector<std::uint64_t>>> find_tiles(const PyramidPlan& plan, const NodeSource* source,
                                                           const Run& run = {});

/// The blocks of a pyramid: its tiles of plan.block_level, along Hilbert's curve, so that neighbours in the list are
/// neighbours on the globe. All tiles below a block are made with it; any process may make any block.
std::vector<TileId> find_blocks(const PyramidPlan& plan);

/// Relative cost of a block, about: 1, and 1000 times the share of it that the source may cover.
std::uint64_t block_cost(const PyramidPlan& plan, TileId block);

/// Makes the tiles of one block that have heights, their siblings if the plan wants them, and the block's own in any
/// case. A tile's bytes are those of make_tile(). Tiles of levels below `deepest` are omitted, and their errors from
/// the report; all else is that of the whole block. REQUIRES: find_blocks() names the block.
///
/// Cost: each node is read once; memory: that of its nodes, 4 · (32 · cells)² bytes. Progress: pass "tiles". Fails as
/// make_tile() and the sink do, and with kCancelled.
Result<BlockReport> make_block(const PyramidPlan& plan, TileId block, const NodeSource& source, TileSink& sink,
                               const Run& run = {}, int deepest = std::numeric_limits<int>::max());

/// A hash of all that make_block() reads from the source, nodes and samples, and of the shapes of water masks: blocks
/// of one hash and one plan have the same tiles and errors. 0 for a block without heights and masks. Cost: the nodes
/// are read; memory as make_block(). Fails as the source does.
Result<std::uint64_t> hash_block(const PyramidPlan& plan, TileId block, const NodeSource& source, int threads = 0);

/// Makes the tiles above the blocks, of nodes reduced to 256 cells a side. Their node_error is an upper bound for all
/// nodes below, which the reduction carries upwards. REQUIRES: `blocks` are those of find_blocks(), in any order.
/// Returns what is known of all tiles. Progress and failures as make_block(), and kInput for damaged `reduced`.
Result<PyramidReport> finish_pyramid(const PyramidPlan& plan, std::vector<BlockReport> blocks, TileSink& sink,
                                     const Run& run = {});

/// Makes all tiles of a pyramid: those with heights; of levels up to plan.block_level also the others that clients need
/// to reach them: all roots, and the siblings of each tile. The same as make_block() for each of find_blocks() in
/// their order, and then finish_pyramid().
Result<PyramidReport> make_pyramid(const PyramidPlan& plan, const NodeSource& source, TileSink& sink,
                                   const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
