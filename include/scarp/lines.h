// Read lines and polygons of vector files, for breaklines, shores and rivers (features.h), regions (tolerances.h) and
// cutlines.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(auto&& dikes, scarp::read_lines("dikes.geojson", {.crs = dem.info.crs}));
//     scarp::LineConstraints breaklines;  // Features::breaklines
//     breaklines.lines = std::move(dikes.lines);
//     breaklines.affine = scarp::map_affine(dem.info, dem.rows);
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

enum class LineRole {
  kLine,   ///< along a line, closed or not
  kOuter,  ///< the outer ring of a polygon
  kHole,   ///< a ring that cuts a hole into it
};

inline constexpr std::uint32_t kNoPolygon = 0xffffffff;

/// How a mesh treats a line as a constraint (Features::breaklines).
enum class LineKind : std::uint8_t {
  kBreakline,  ///< stays as it is, as a chain of edges
  kRiver,      ///< the same, but yields
  /// The following are found in the raster. They are inserted before the surface is refined, in the greedy order,
  /// together with all other lines. kWall and kRidge are only a start: from normal effort on their edges may change,
  /// and their vertices may be removed, or moved where vertices are free. They stay where high effort must keep
  /// vertices on samples.
  kWall,       ///< along the top or foot of a wall (detect_cliffs()): yields, and never changes a sample
  kRidge,      ///< a ridge or valley (detect_ridges()), a preference
  kKeptRidge,  ///< a ridge or valley whose edges stay
};

struct Line {
  /// x, y, z; at least two, and no two successive ones are equal. x and y are finite. z is NaN where the height is not
  /// known (a soft line), else finite (a hard one). A ring ends with its first point and has at least four.
  std::vector<std::array<double, 3>> points;
  LineRole role = LineRole::kLine;
  std::uint32_t polygon = kNoPolygon;  ///< the rings of one polygon share it; counts from 0 in a LineSet
  std::string name;                    ///< for messages: "shores.gpkg:lakes feature 12"
  LineKind kind = LineKind::kBreakline;

  bool is_ring() const { return role != LineRole::kLine; }
  /// True if this line adopts the other's height at a hard line that does not yield; there is never a conflict.
  bool yields() const { return kind == LineKind::kRiver || kind == LineKind::kWall; }
};

inline bool is_wall(const Line& line) { return line.kind == LineKind::kWall; }
inline bool is_ridge_line(const Line& line) {
  return line.kind == LineKind::kRidge || line.kind == LineKind::kKeptRidge;
}

/// The content of a vector layer.
struct LineSet {
  std::vector<Line> lines;  ///< in the order of the layer; a polygon's outer ring comes before its holes
  std::string path, layer;  ///< their source, for messages
  std::string format;       ///< "GPKG", "GeoJSON", …
  std::string crs;          ///< CRS of the layer: "EPSG:32611", WKT, or empty
  std::uint32_t polygons = 0;
  std::vector<std::string> warnings;  ///< sentences for the user: points that were omitted, an unknown CRS
};

/// The height of a vertex where hard lines of different heights meet.
enum class LineConflict {
  kError,    ///< the call fails and names the lines
  kFirst,    ///< the height of the line that was given first
  kMean,     ///< mean of all lines that pass
  kHighest,  ///< highest of all lines that pass
};

/// Breaklines: lines that become chains of edges of the mesh.
struct LineConstraints {
  std::vector<Line> lines;  ///< from read_lines(); polygons count by their rings. EMPTY: no constraints
  /// From samples to the coordinates of the lines, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  LineConflict conflict = LineConflict::kError;
};

/// The surface within the polygons and on their rings stays. Within a polygon rings count even-odd: holes,
/// self-intersecting rings and bow-ties need nothing special, and parts enclosed twice are outside.
struct Cutline {
  /// Rings of polygons, as read_lines() and close_rings() give them; their heights are ignored. EMPTY: no cut.
  /// Functions with a cutline fail with kInput for a vertex more than 2^41 samples away, and name it.
  std::vector<Line> rings;
  /// From samples to the coordinates of the rings, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
};

/// The breakline farthest above or below the raster, at a vertex as given; lines that are 0 everywhere count tenfold.
struct FarthestLine {
  std::string name;         ///< empty: none has heights
  double distance = 0;      ///< in z units
  bool is_at_zero = false;  ///< all its heights are 0
};

}  // namespace scarp

#pragma GCC visibility pop
