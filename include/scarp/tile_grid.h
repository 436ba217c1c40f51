// Grids of tiles: which tiles each level has, and where they and the nodes between them lie.
//
// All grids are quadtrees: a tile of level z + 1 is a quarter of one of level z; y counts from the south. Nodes divide
// a tile's sides into equal numbers of steps; each node of a level is one of the finer levels, too.
//
// Clients place vertices by the tile's bounds in degrees, linearly. So do nodes of the geographic grid lie, evenly;
// rows of the Mercator grid are evenly apart on its map, not in degrees.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

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

enum class GridKind {
  kGeographic,  ///< TMS in degrees: two tiles of 180° at level 0, side by side
  kMercator,    ///< TMS on the map of Web Mercator: one tile at level 0, which ends at ±85.0511°
};

struct NodeWindow;

/// Whoever needs to know where a tile or a node lies asks its grid.
struct TileGrid {
  GridKind kind = GridKind::kGeographic;

  /// "geographic", "mercator".
  std::string_view name() const;
  static std::optional<TileGrid> find(std::string_view name);
  /// What layer.json calls it.
  std::string_view projection() const;
  static std::optional<TileGrid> find_projection(std::string_view projection);

  /// Tiles of level 0, side by side.
  std::uint32_t roots() const { return kind == GridKind::kMercator ? 1 : 2; }
  std::uint32_t columns(int z) const { return roots() << z; }
  std::uint32_t rows(int z) const { return std::uint32_t{1} << z; }
  bool has(TileId id) const { return id.z >= 0 && id.z <= kMaxTileLevel && id.x < columns(id.z) && id.y < rows(id.z); }

  /// Degrees to add to a tile's bounds for all its places that a source may cover: turns, where the last column of
  /// tiles is next to the first.
  std::span<const double> turns() const;
  /// Whether the first and the last row of nodes are a pole each: one place.
  bool has_poles() const { return kind == GridKind::kGeographic; }
  /// Whether rows of nodes are evenly apart in degrees.
  bool has_even_rows() const { return kind == GridKind::kGeographic; }

  DegreeBox bounds() const;
  DegreeBox bounds_of(TileId id) const;
  /// Degrees of a row of nodes, where rows count from 0, the northern end, to `last_row`, a power of two. The same bits
  /// on every machine.
  double latitude(std::int64_t row, std::int64_t last_row) const;
  /// From a row of nodes to the next, in degrees, over the same from a column to the next: at a latitude.
  double row_step(double latitude) const;
  /// Degrees between two nodes, the larger of both ways.
  double largest_step(std::int64_t per_turn) const { return 360 / static_cast<double>(per_turn); }
  /// Nodes' steps from the western to the eastern end of the grid, for so many along a side of a tile of level z.
  std::int64_t per_turn(int z, std::int32_t steps) const { return (std::int64_t{steps} << z) * roots(); }
  /// Rows of nodes count from 0 to this.
  std::int64_t last_row(std::int64_t per_turn) const { return per_turn / roots(); }
  /// The nodes of a tile with so many steps a side, and `halo` more around it but for rows beyond the grid's ends.
  NodeWindow window_of(TileId id, std::int32_t steps, std::int32_t halo = 0) const;

  /// The error in metres that clients assume for a level of quantized-mesh: of an ellipsoid's `semi_major` axis, 65
  /// samples a tile (CesiumJS, cesium-native).
  double geometric_error(int z, double semi_major = 6378137) const;
  /// Metres from west to east of a tile, at most.
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
  /// Whether a row is a pole: one place.
  bool is_pole(std::int64_t of_row) const { return grid.has_poles() && (of_row == 0 || of_row == last_row()); }
  /// Degrees of a column's nodes, −180 … 180, the same bits after each turn.
  double longitude(std::int64_t of_col) const {
    const std::int64_t wrapped = ((of_col % per_turn) + per_turn) % per_turn;
    return -180 + 360 * (static_cast<double>(wrapped) / static_cast<double>(per_turn));
  }
  double latitude(std::int64_t of_row) const { return grid.latitude(of_row, last_row()); }
};

}  // namespace scarp

#pragma GCC visibility pop
