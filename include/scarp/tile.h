// Plan a pyramid of terrain tiles on the globe and make its tiles, as meshes and as bytes of quantized-mesh. For tile
// sets from raster files, see tile_job.h.
//
// The grid (TileGrid) defines the tiles. A tile depends only on its id, the plan, and the heights of its nodes and of a
// few nodes around it. It does not depend on neighbouring tiles, so tiles may be made in any order, on any machine. Two
// neighbours still have the same vertices, heights and normals on their common edge.
//
// NODES. The source is sampled at the nodes of a lattice, with `cells` cells a side for tiles of the finest level.
// Tiles of the plan's block level and of finer levels use all nodes in their area. The max error of a tile holds at all
// its nodes.
//
// A LOCAL GRID lies on a plane. Its nodes are the samples of one raster, and tiles end at the raster's edge. All terms
// for the earth's curvature are 0.
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

// Grids of tiles.
//
// All grids are quadtrees: a tile of level z + 1 is a quarter of one of level z; y counts from the south. Nodes divide
// a tile's sides into equal numbers of steps; each node of a level is also a node of all finer levels.
//
// Clients place vertices linearly between the tile's bounds in degrees. Nodes of the geographic grid are evenly spaced
// in degrees too; rows of the Mercator grid are evenly spaced on its map, not in degrees.
//
// On a local grid, longitude and latitude are not degrees but cells of the raster, counted from its south-western
// sample.

struct TileId {
  int z = 0;
  std::uint32_t x = 0, y = 0;  ///< y from the south

  friend bool operator==(const TileId&, const TileId&) = default;
};

inline constexpr int kMaxTileLevel = 23;

struct DegreeBox {
  double west = 0, south = 0, east = 0, north = 0;
};

/// Longitudes and latitudes of a line's vertices. A step of more than 180° runs the other way around the globe.
using DegreeLine = std::vector<std::array<double, 2>>;

enum class GridKind {
  kGeographic,  ///< TMS in degrees: two tiles of 180° at level 0, side by side
  kMercator,    ///< TMS in Web Mercator: one tile at level 0, up to ±85.0511°
  kLocal,       ///< on a plane: one square at level 0, whose south-western corner is the raster's
};

struct LocalRaster {
  std::int32_t cols = 0, rows = 0;  ///< samples, at least 2 each
  double cell_x = 1, cell_y = 1;    ///< metres, or other units; rounded to 29 bits, so that positions are exact
  std::int64_t side = 0;            ///< cells along a side of the square: as for a tile of the finest level, times a
                                    ///< power of two

  /// The sample next to the middle, from which positions are counted. If `side` exceeds 32768, positions of all levels
  /// are whole steps from this sample.
  std::int64_t centre_col() const { return centre_of(cols); }
  std::int64_t centre_row() const { return centre_of(rows); }  ///< from the southern row

  friend bool operator==(const LocalRaster&, const LocalRaster&) = default;

  static constexpr std::int64_t kPlaces = 32768;  ///< vertex positions along a side of a tile

 private:
  std::int64_t centre_of(std::int64_t samples) const {
    const std::int64_t step = side > kPlaces ? side / kPlaces : 1;
    return (samples - 1) / 2 / step * step;
  }
};

/// A range of nodes, both ends included.
struct NodeRange {
  std::int64_t first = 0, last = 0;
};

struct NodeWindow;

/// The grid defines the positions of tiles and nodes.
struct TileGrid {
  GridKind kind = GridKind::kGeographic;
  LocalRaster local = {};  ///< raster of a local grid

  /// The smallest grid that holds the raster. A tile of the finest level has `cells` cells a side. The sides of a cell
  /// are rounded to 29 bits.
  static TileGrid of_raster(std::int32_t cols, std::int32_t rows, double cell_x, double cell_y, int cells);

  bool is_flat() const { return kind == GridKind::kLocal; }
  /// The finest level of a local grid, whose nodes are the raster's samples.
  int finest_local(int cells) const;

  /// "geographic", "mercator", "local". For a local grid, find() sets only the kind.
  std::string_view name() const;
  static std::optional<TileGrid> find(std::string_view name);
  /// The grid's name in layer.json; "" for a local grid.
  std::string_view projection() const;
  static std::optional<TileGrid> find_projection(std::string_view projection);

  /// Number of tiles of level 0, side by side.
  std::uint32_t roots() const { return kind == GridKind::kGeographic ? 2 : 1; }
  std::uint32_t columns(int z) const { return roots() << z; }
  std::uint32_t rows(int z) const { return std::uint32_t{1} << z; }
  /// True for the grid's tiles; on a local grid false for tiles outside the raster.
  bool has(TileId id) const;
  /// Length of a tile's side in the units of its vertices' u and v. On local grids, nodes lie at whole units.
  std::int32_t side_units() const { return is_flat() ? static_cast<std::int32_t>(LocalRaster::kPlaces) : 32767; }

  /// Full turns, in degrees. Adding a turn to a tile's bounds results in a copy of the tile that a source may cover.
  /// The last column of tiles is next to the first.
  std::span<const double> turns() const;
  /// True if the first and the last row of nodes are each a pole: a single point.
  bool has_poles() const { return kind == GridKind::kGeographic; }
  /// True if rows of nodes are evenly spaced in degrees.
  bool has_even_rows() const { return kind != GridKind::kMercator; }
  /// Nodes that may have heights: on a local grid, those of the raster and, where its edge has no nodes, the next ones
  /// beyond it; on other grids all nodes, even beyond a full turn.
  NodeRange land_columns(std::int64_t per_turn) const;
  NodeRange land_rows(std::int64_t per_turn) const;

  DegreeBox bounds() const;
  DegreeBox bounds_of(TileId id) const;
  /// Latitude of a row of nodes. Rows count from 0, the northern end, to `last_row`, a power of two. Returns the same
  /// bits on every machine.
  double latitude(std::int64_t row, std::int64_t last_row) const;
  /// Longitude of a column of nodes, from −180 to 180. Columns a whole turn apart give the same bits.
  double longitude(std::int64_t col, std::int64_t per_turn) const {
    if (is_flat()) return static_cast<double>(local.side) * (static_cast<double>(col) / static_cast<double>(per_turn));
    const std::int64_t wrapped = ((col % per_turn) + per_turn) % per_turn;
    return -180 + 360 * (static_cast<double>(wrapped) / static_cast<double>(per_turn));
  }
  /// Distance between two rows of nodes in degrees, divided by that between two columns, at a latitude.
  double row_step(double latitude) const;
  /// Degrees between two neighbouring nodes, in the direction with the larger step.
  double largest_step(std::int64_t per_turn) const {
    return (is_flat() ? static_cast<double>(local.side) : 360) / static_cast<double>(per_turn);
  }
  /// Steps between nodes from the western to the eastern end of the grid, for `steps` along a side of a tile of level
  /// z.
  std::int64_t per_turn(int z, std::int32_t steps) const { return (std::int64_t{steps} << z) * roots(); }
  /// Number of the last row of nodes; the first is 0.
  std::int64_t last_row(std::int64_t per_turn) const { return per_turn / roots(); }
  /// The nodes of a tile with `steps` steps a side, and `halo` more around it, except rows beyond the grid's ends.
  NodeWindow window_of(TileId id, std::int32_t steps, std::int32_t halo = 0) const;

  /// The error in metres that clients (CesiumJS, cesium-native) assume for a level of quantized-mesh, on an ellipsoid
  /// with this `semi_major` axis and 65 samples a tile. On a local grid, this error is the same share of a tile's side.
  double geometric_error(int z, double semi_major = 6378137) const;
  /// Largest side of a tile, in metres.
  double tile_width(int z, double semi_major) const;
};

/// A rectangle of nodes. Nodes divide the grid from west to east into `per_turn` steps.
struct NodeWindow {
  std::int64_t per_turn = 0;
  std::int64_t col = 0;  ///< from the western end; any number, since columns repeat after a turn
  std::int64_t row = 0;  ///< from the northern end, southwards; 0 … grid.last_row(per_turn)
  int cols = 0, rows = 0;
  TileGrid grid = {};

  std::int64_t last_row() const { return grid.last_row(per_turn); }
  /// True if a row is a pole: a single point.
  bool is_pole(std::int64_t of_row) const { return grid.has_poles() && (of_row == 0 || of_row == last_row()); }
  /// See TileGrid::longitude().
  double longitude(std::int64_t of_col) const { return grid.longitude(of_col, per_turn); }
  double latitude(std::int64_t of_row) const { return grid.latitude(of_row, last_row()); }
};

// Vertical datums.

/// The reference surface of heights, such as the sea.
class HeightZero {
 public:
  virtual ~HeightZero() = default;
  /// Finds the surface's heights in metres above the ellipsoid at positions in degrees; NaN where unknown. Each height
  /// depends only on its position. Several threads may call it at once. The spans have equal sizes.
  virtual void find(std::span<const double> longitudes, std::span<const double> latitudes,
                    std::span<double> heights) const = 0;
};

/// The geoid EGM96 above the ellipsoid of WGS 84, built in: a grid of 15 minutes of arc, in whole centimetres, with
/// bilinear interpolation. Heights are within 6 mm of PROJ's for the same grid (egm96_15.gtx) everywhere, and have the
/// same bits on every machine. Cost: 20 ms and 4 MB at the first call.
std::shared_ptr<const HeightZero> egm96();

/// A reference surface as a grid of heights.
struct ZeroGrid {
  int cols = 0, rows = 0;      ///< at least 2
  std::vector<float> heights;  ///< cols · rows, row by row; metres above the ellipsoid, NaN where unknown
  RasterPlace place;           ///< position of the grid's nodes
};

/// Interpolates bilinearly between the four nodes around a position; up to half a cell outside the grid, the outer
/// nodes are used. The surface is unknown where one of the nodes used is unknown. After the last column, a grid in
/// degrees around the whole globe continues with the first. Fails with kUsage for a wrong number of heights, and as
/// make_node_source() does.
Result<std::shared_ptr<const HeightZero>> make_grid_zero(ZeroGrid grid);

// Heights by position, from which tiles are made.

/// Neighbouring samples of a source on a straight line, at equal steps in degrees; NaN is nodata.
struct SampleRow {
  double longitude = 0, latitude = 0;            ///< position of the first sample
  double step_longitude = 0, step_latitude = 0;  ///< step to the next sample
  std::span<const float> heights;                ///< metres, as from NodeSource::read()
};
using SampleVisitor = std::function<void(const SampleRow&)>;

class NodeSource {
 public:
  virtual ~NodeSource() = default;
  /// Writes cols × rows heights in metres to `out`, the northern row first; NaN is nodata. A node's height is a
  /// function of its position only. Several threads may call it at once. Fails as the samples' source does.
  virtual Result<void> read(const NodeWindow& window, std::span<float> out) const = 0;
  /// A part of the window outside of which no node has a height; empty if none has. DEFAULT: the whole window.
  virtual NodeWindow land(const NodeWindow& window) const { return window; }
  /// True if nodes are interpolated from samples that visit_samples() passes. DEFAULT: false.
  virtual bool has_samples() const { return false; }
  /// Passes all samples in the box and some samples around it to `visit`, some of them twice. Longitudes continue
  /// beyond 180° if the box does. A row is valid only during its visit. Several threads may call it at once. Fails as
  /// the samples' source does. DEFAULT: passes none.
  virtual Result<void> visit_samples(const DegreeBox& /*box*/, const SampleVisitor& /*visit*/) const { return {}; }
};

/// Returns nodes interpolated between the samples of a raster: cubic (Catmull-Rom) where all 16 samples around a node
/// are heights, else bilinear between the valid ones of the four nearest samples. A node has no height where the
/// nearest sample has none. With `from_degrees`, the position of a node in the raster is exact at each 16th node and
/// interpolated in between, as is the position of a sample on the globe. Borrows the field's samples. Fails with kUsage
/// for an affine map without an inverse.
Result<std::unique_ptr<NodeSource>> make_node_source(const HeightField& field, const RasterPlace& place);

/// Returns the samples of a local grid's raster, with north up, as nodes of the finest level; coarser nodes are every
/// second, fourth … sample. Beyond the raster, its outermost samples are repeated. Borrows the field's samples.
std::unique_ptr<NodeSource> make_local_nodes(const HeightField& field);

/// Returns the nodes of `source`, raised by the height of `zero`. This height is exact at positions at most 1/32°
/// apart, and interpolated in between. read() fails with kInput for a node where `zero` is unknown. Borrows the source.
std::unique_ptr<NodeSource> make_raised_source(const NodeSource& source, std::shared_ptr<const HeightZero> zero);

struct StackedSource {
  const NodeSource* nodes = nullptr;  ///< borrowed
  DegreeBox covered = {};             ///< no node elsewhere has a height
};
/// Several sources as one: a node has the height of the first source with a height there. visit_samples() passes
/// samples only if there is one source. Cost: each source reads a rectangle around the nodes that do not have a height
/// yet.
std::unique_ptr<NodeSource> make_stacked_source(std::vector<StackedSource> sources);

/// The rectangle in degrees that the raster covers, with half a cell around the outer samples. Fails with kInput if the
/// raster's outline has no longitude or latitude, or lies beyond a pole or more than 720 degrees from Greenwich.
/// `to_degrees` maps x and y to degrees; it may be null as in RasterPlace.
Result<DegreeBox> degrees_covered(const HeightField& field, const std::array<double, 6>& affine,
                                  const PointTransform* to_degrees);

// Pyramids of tiles: the plan, a tile, statistics.
//
// HEIGHTS are multiples of a quantum for each level. A tile's header is chosen so that clients decode a height to the
// same float32 in all tiles.

class TileLines;
struct TileWaters;

struct PyramidSettings {
  /// Cells between nodes along a side of tiles of the finest level, a power of two, 16 … 256. DEFAULT: 128.
  int cells = 128;
  /// The finest level. DEFAULT (−1): the first level whose nodes are at most 1.1 cells of the source apart.
  int max_zoom = -1;
  /// Max error of the finest level in metres; above 0. DEFAULT (0): a quarter of the level's geometric error, or the
  /// precision of the format for such heights if that is larger.
  double max_error = 0;
  /// A level's max error is its geometric error divided by this quality, or max_error if that is larger. At least 1/2.
  /// DEFAULT: 2.
  double quality = 2;
  /// DEFAULT: kNormal.
  Effort effort = Effort::kNormal;
  /// Height for nodes without a height, in metres. DEFAULT: 0, the ellipsoid.
  float background = 0;
  /// True if each tile with a child has all four children, even those without heights. Where a child is missing,
  /// clients of 3D Tiles show a hole; clients of quantized-mesh show that part of the parent. DEFAULT: false.
  bool has_siblings = false;
  Geodetic ellipsoid = {};
  TileGrid grid = {};  ///< DEFAULT: geographic.
  /// Blocks that do not touch this box are treated as nodata. The tiles of the other blocks equal those of the whole
  /// pyramid. DEFAULT: all.
  std::optional<DegreeBox> only = {};
  /// Largest size of a stored tile. For larger tiles, the max error of the interior (not of the border) is doubled
  /// until the tile fits or only its border remains. DEFAULT: 0, any.
  std::uint64_t max_tile_bytes = 0;
  /// True if max errors also hold at the source's samples, each at its own position. The finest level then has nodes
  /// half as far apart, since triangles cannot follow samples that are far from the surface between nodes. REQUIRES
  /// then: a source that has_samples(). DEFAULT: false.
  bool binds_samples = false;
  /// Lines that become edges of all tiles' meshes. DEFAULT: none.
  std::vector<DegreeLine> lines = {};
};

struct PyramidLevel {
  double geometric_error = 0;  ///< metres
  double max_error = 0;        ///< max error of the tiles' meshes at their nodes, metres
  double quantum = 0;          ///< heights are multiples of this power of two, metres
  int segments = 1;            ///< edges of triangles span at most 1/segments of a tile, because of the earth's
                               ///< curvature
};

struct PlannedSource {
  DegreeBox covered = {};
  int max_zoom = 0;  ///< the finest level that the source needs
};

/// The resolved settings: everything on which a tile depends, except its nodes.
struct PyramidPlan {
  int cells = 128;
  int block_level =
      0;  ///< tiles of this level and of finer ones use all nodes; coarser tiles use nodes reduced to 256 cells a side
  std::vector<PyramidLevel> levels;  ///< 0 … the finest
  double least_quantum = 0;          ///< the finest quantum that can represent the source's heights; 0 in a plan read
                                     ///< from a file
  Effort effort = Effort::kNormal;
  float background = 0;
  bool has_siblings = false;  ///< see PyramidSettings
  std::uint64_t max_tile_bytes = 0;
  bool binds_samples = false;                        ///< see PyramidSettings
  std::shared_ptr<const TileLines> lines = nullptr;  ///< null: none
  Geodetic ellipsoid = {};
  TileGrid grid = {};
  DegreeBox covered = {};  ///< area covered by the source
  /// Sources of a stack, else empty. Tiles below the block level are made only where a source needs their level.
  std::vector<PlannedSource> sources = {};
  /// Water of the nodes; null without water.
  std::shared_ptr<const TileWaters> waters = nullptr;
  /// True if tiles have water masks of the lakes. REQUIRES then: waters; quantized-mesh. DEFAULT: false.
  bool has_water_mask = false;

  int max_zoom() const { return static_cast<int>(levels.size()) - 1; }
};

/// A tile's mesh, with the values that clients decode.
struct TerrainTile {
  TileId id;
  std::int32_t units = 32767;                        ///< length of the tile's side, as TileGrid::side_units()
  std::vector<std::uint16_t> u, v;                   ///< 0 … units: u from the west, v from the south
  std::vector<std::int32_t> heights;                 ///< in quanta of the level
  std::vector<std::array<std::uint8_t, 2>> normals;  ///< octahedral, earth-centred or on the plane
  std::vector<std::uint32_t> triangles;              ///< counter-clockwise seen from above
  double quantum = 1;
  double max_error = 0;  ///< max error required of its interior, in metres: the level's, or more because of
                         ///< max_tile_bytes
  /// Number of line segments that are not edges, since rounding to 32767ths of the tile would flip triangles.
  std::uint64_t lines_left_out = 0;

  /// Largest |mesh − node| in metres over all nodes of the tile, with decoded heights and edges that are straight on
  /// the map. Above the plan's block level, this is an upper bound.
  double node_error = 0;
  /// Max depth of flat triangles below the ellipsoid's curve, in metres. In space, it adds to node_error.
  double sag = 0;

  double bound() const { return node_error + sag; }

  /// Like node_error, the largest |mesh − sample| over the source's samples in the tile, each at its own position;
  /// above the plan's block level, an upper bound. Samples next to a node without a height, where the mesh falls to the
  /// background, do not count. NaN if unknown: the source has no samples, or they were not examined.
  double source_error = std::numeric_limits<double>::quiet_NaN();
};

/// Encodes a tile to the bytes to store. Several threads call it at once.
using TileEncoder = std::function<Result<std::vector<std::uint8_t>>(const TerrainTile&)>;

struct KeptTile {
  TerrainTile tile;
  std::vector<std::uint8_t> bytes;
};

/// The destination of a pyramid's tiles.
class TileSink {
 public:
  virtual ~TileSink() = default;
  /// Returns the bytes to store. Several threads call it at once.
  virtual Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const = 0;
  /// Called by one thread at a time, in an order independent of the number of threads.
  virtual Result<void> put(TileId id, std::span<const std::uint8_t> bytes) = 0;
};

struct LevelSummary {
  std::uint64_t tiles = 0, triangles = 0, bytes = 0;
  double node_error = 0, bound = 0;  ///< the largest among its tiles
  double source_error = 0;           ///< the largest among its tiles; NaN if any is NaN
  /// Tiles whose node_error (or source_error if the plan binds samples) exceeds their max error. Causes: rounded
  /// positions cannot follow a cliff, nodes cannot follow a sample, or, above the block level, reduced nodes prevent a
  /// smaller proven error.
  std::uint64_t over = 0;
  std::uint64_t coarser = 0;         ///< tiles whose max error exceeds the level's because of plan.max_tile_bytes
  std::uint64_t oversized = 0;       ///< tiles of `coarser` whose borders already exceed plan.max_tile_bytes
  std::uint64_t lines_left_out = 0;  ///< sum of TerrainTile::lines_left_out
};

struct PyramidReport {
  bool has_heights = false;                       ///< true if some node has a height
  std::vector<LevelSummary> levels;               ///< 0 … the finest
  std::vector<std::vector<std::uint64_t>> tiles;  ///< for each level, y · 2^32 + x of its tiles, sorted
};

struct BlockReport {
  TileId block;
  PyramidReport report;
  /// For finish_pyramid(): the block's nodes reduced to 128 cells a side, and error bounds of this reduction; 390 kB,
  /// the same bytes on every machine. Empty for a block without heights.
  std::vector<std::uint8_t> reduced;
  std::uint64_t hash = 0;  ///< result of hash_block()
  /// Cost of the block: CPU time, and the peak memory of the process until then. Set by callers that measure it.
  double core_seconds = 0;
  std::uint64_t memory = 0;
};

// The quantized-mesh format: one file for each tile.

/// Returns the bytes of a quantized-mesh 1.0 file, not compressed, with normals (extension 1) and, unless empty,
/// `water_mask` (extension 2). Deterministic: calls no function of the machine's mathematics library.
std::vector<std::uint8_t> encode_quantized_mesh(const TerrainTile& tile, const Geodetic& ellipsoid = {},
                                                const TileGrid& grid = {},
                                                std::span<const std::uint8_t> water_mask = {});

/// The contents of a quantized-mesh file, as clients read them.
struct QuantizedMesh {
  std::array<double, 3> center{};
  float min_height = 0, max_height = 0;
  std::array<double, 4> sphere{};  ///< centre, radius
  std::array<double, 3> horizon_point{};
  std::vector<std::uint16_t> u, v, h;  ///< 0 … 32767
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> west, south, east, north;  ///< vertices on the edges
  std::vector<std::array<std::uint8_t, 2>> normals;     ///< empty, or one a vertex
  /// 0 land, 255 water: one value for the whole tile, or 256 rows of 256 texels from the north. Empty without a mask;
  /// other sizes are faults of the file.
  std::vector<std::uint8_t> water_mask;

  /// The height that clients decode: min + (max − min) · h / 32767.
  double height(std::size_t vertex) const {
    const double low = double{min_height}, high = double{max_height};
    return low + (high - low) * (static_cast<double>(h[vertex]) / 32767);
  }
};

/// Reads a quantized-mesh file. Fails with kInput for other or damaged files; checks each length and index in the file.
Result<QuantizedMesh> decode_quantized_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

struct SourceFacts {
  DegreeBox covered = {};
  double cell = 0;          ///< size of a cell in metres along the ground, the geometric mean of both directions, above
                            ///< 0
  double min = 0, max = 0;  ///< bounds of its heights, metres
  double cell_degrees = 0;  ///< size of a cell in degrees, for a raster in degrees; else 0
};

/// The conflicts among the settings, each as a sentence; plan_pyramid() fails with kUsage and the first. Empty: none.
std::vector<std::string> list_conflicts(const PyramidSettings& settings);

/// Makes a plan. Fails with kUsage for settings out of range.
Result<PyramidPlan> plan_pyramid(const SourceFacts& source, const PyramidSettings& settings = {});
/// Makes a plan for a stack of at least one source. The plan's finest level, and the spacing of nodes everywhere, are
/// the finest that any source needs.
Result<PyramidPlan> plan_pyramid(std::span<const SourceFacts> stack, const PyramidSettings& settings = {});

/// Replaces the plan's lines, for its levels and covered area.
void set_lines(PyramidPlan& plan, std::vector<DegreeLine> lines);

/// The finest level that a source needs in a tile, or around it as far as the tile's normals reach; −1 if no source has
/// heights there.
int finest_level(const PyramidPlan& plan, TileId id);

/// Makes the tile as stored in a set, within plan.max_tile_bytes if possible. The tile depends only on id, plan, nodes
/// and encoder.
///
/// At plan.block_level and below, the tile's node_error is at most its max error. An exception is a cliff that the
/// tile's positions, rounded to 32767ths of its side, cannot follow. If the plan binds samples, the same holds for
/// source_error, except at samples that are too far from the surface between the nodes around them.
///
/// Above plan.block_level, only the nodes that the tile's mesh needs are read. This mesh is that of finish_pyramid(),
/// without the proof: node_error is NaN, since the nodes in between were not examined. Cost: some 70,000 nodes, read
/// one by one if far apart.
///
/// REQUIRES: 0 <= id.z <= plan.max_zoom(). Fails as the source and the encoder do.
Result<KeptTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source, const TileEncoder& encode);
/// The same without a limit on the tile's bytes.
Result<TerrainTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source);

/// Lists the tiles of make_pyramid() without making them: for each level, y · 2^32 + x of its tiles, sorted. Reads each
/// node once. Without a source, it reads no nodes, and lists tiles below the blocks if the plan's source may cover
/// them. Progress: pass "look". Fails as the source does, and with kCancelled.
Result<std::vector<std::vector<std::uint64_t>>> find_tiles(const PyramidPlan& plan, const NodeSource* source,
                                                           const Run& run = {});

/// The blocks of a pyramid: its tiles of plan.block_level, along a Hilbert curve, so that neighbours in the list are
/// neighbours on the globe. All tiles below a block are made with it; any process may make any block.
std::vector<TileId> find_blocks(const PyramidPlan& plan);

/// Approximate relative cost of a block: 1, plus 1000 times the share of it that the source may cover.
std::uint64_t block_cost(const PyramidPlan& plan, TileId block);

/// Makes the tiles with heights in one block, their siblings if the plan requires siblings, and always the block's own
/// tile. A tile's bytes are those of make_tile(). Tiles finer than level `deepest`, and their errors in the report, are
/// omitted; all other results are those of the whole block. REQUIRES: find_blocks() lists the block.
///
/// Cost: each node is read once. Memory: that of the nodes, 4 · (32 · cells)² bytes. Progress: pass "tiles". Fails as
/// make_tile() and the sink do, and with kCancelled.
Result<BlockReport> make_block(const PyramidPlan& plan, TileId block, const NodeSource& source, TileSink& sink,
                               const Run& run = {}, int deepest = std::numeric_limits<int>::max());

/// A hash of all nodes and samples that make_block() reads from the source, and of the shapes of water masks. Blocks
/// with the same hash and plan have the same tiles and errors. 0 for a block without heights and masks. Cost: the nodes
/// are read. Memory: as make_block(). Fails as the source does.
Result<std::uint64_t> hash_block(const PyramidPlan& plan, TileId block, const NodeSource& source, int threads = 0);

/// Makes the tiles above the blocks from nodes reduced to 256 cells a side. The reduction stores error bounds, so the
/// tiles' node_error is an upper bound for all nodes below. REQUIRES: `blocks` are those of find_blocks(), in any
/// order. Returns the report of all tiles. Progress and failures are those of make_block(). Also fails with kInput for
/// a damaged `reduced`.
Result<PyramidReport> finish_pyramid(const PyramidPlan& plan, std::vector<BlockReport> blocks, TileSink& sink,
                                     const Run& run = {});

/// Makes all tiles of a pyramid: those with heights and, on levels up to plan.block_level, the tiles that clients need
/// to reach these (all roots, and the siblings of each tile). Equivalent to make_block() for each block of
/// find_blocks() in order, then finish_pyramid().
Result<PyramidReport> make_pyramid(const PyramidPlan& plan, const NodeSource& source, TileSink& sink,
                                   const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
