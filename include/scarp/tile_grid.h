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
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

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

  /// The smallest that holds the raster, with so many cells a side of a tile of its finest level. Rounds the cell's
  /// sides to 29 bits.
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

}  // namespace scarp

#pragma GCC visibility pop
