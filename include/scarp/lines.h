// Lines and polygons of vector files: breaklines, cutlines, the shores of lakes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/progress.h"
#include "scarp/result.h"

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
  kWall,       ///< along the top or foot of a wall (cliffs.h): yields, and never changes a sample
  kRidge,      ///< a ridge or valley (ridges.h), a preference
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

/// From samples to the map coordinates of lines: those of the raster's file, or x = col, y = rows − 1 − row if the file
/// has none.
std::array<double, 6> map_affine(const RasterInfo& info, int rows);

struct ReadLinesOptions {
  /// The CRS of x and y, as RasterInfo::crs. DEFAULT: the layer's.
  std::string crs = {};
  /// The attribute that holds the height of a whole feature, such as a contour's; features without a value are soft.
  /// DEFAULT: the third coordinate, soft where there is none.
  std::string z_field = {};
  bool ignore_z = false;  ///< all lines are soft. DEFAULT: false.
  ProgressCallback progress = {};
};

/// Reads the lines and polygons of one layer, by GDAL: GeoPackage, GeoJSON, Shapefile, FlatGeobuf, DXF, CSV with WKT, …
/// `path` is a file, a URL or a /vsi… name. A layer may follow a colon: "dem.gpkg:ridges". Without a layer name, the
/// file must have exactly one layer that can hold lines or polygons.
///
/// Multilines, multipolygons and collections become their parts; arcs become chords of 4 degrees at most. x and y are
/// transformed vertex by vertex from the layer's CRS; between two vertices a line is straight in the wanted CRS.
/// Heights stay; NaN heights are interpolated between the other heights of the line. A layer without CRS is assumed to
/// be in the wanted CRS. Points, features without geometry, and lines and rings of no extent are omitted and counted.
/// Warnings report all of this.
///
/// Fails in one sentence that names file, layer and feature: kInput for a missing file or layer, none or several layers
/// to choose from (they are named), no lines in the layer, a coordinate that is not finite (z may be NaN: unknown), a
/// vertex without coordinates in the wanted CRS, a missing attribute, or an attribute that is no finite number; kUsage
/// for a wanted CRS unknown to GDAL; kCancelled. Cost: a few tenths of a second for a million vertices of a GeoPackage,
/// a second with a transformation (bench/speed/speed_lines.cpp).
Result<LineSet> read_lines(const std::string& path, const ReadLinesOptions& options = {});
/// The lines of several files as one set: polygons count on from file to file. It has no path and no CRS. Fails as
/// read_lines() of the first that does.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options = {});

/// kInput unless all lines are rings of polygons. `user` is what needs them ("--water"), `otherwise` what accepts lines
/// ("--rivers"), or empty: both for the sentence.
Result<void> check_polygons(std::span<const Line> lines, const std::string& user, const std::string& otherwise = {});

}  // namespace scarp

#pragma GCC visibility pop
