// Read lines and polygons from vector files: breaklines, shores and rivers (features.h), regions (tolerances.h) and
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
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

enum class LineRole {
  kLine,   ///< a line, closed or not
  kOuter,  ///< the outer ring of a polygon
  kHole,   ///< the ring of a hole in a polygon
};

inline constexpr std::uint32_t kNoPolygon = 0xffffffff;

/// How a mesh treats a line as a constraint (Features::breaklines).
enum class LineKind : std::uint8_t {
  kBreakline,  ///< remains a chain of edges
  kRiver,      ///< the same, but yields
  /// The following are found in the raster. They are inserted with all other lines before the surface is refined, in
  /// the greedy order. kWall and kRidge lines are only a start: efforts above fast may change their edges, and may
  /// remove their vertices, or move them if vertices are free. These lines do not change if high effort must keep
  /// vertices on samples.
  kWall,       ///< along the top or foot of a wall (detect_cliffs()): yields, and never changes a sample
  kRidge,      ///< a ridge or valley (detect_ridges()), a preference
  kKeptRidge,  ///< a ridge or valley whose edges remain
};

struct Line {
  /// x, y, z; at least two points, successive ones differ. x and y are finite. z is finite (hard line) or NaN, an
  /// unknown height (soft line). A ring ends with its first point and has at least four.
  std::vector<std::array<double, 3>> points;
  LineRole role = LineRole::kLine;
  std::uint32_t polygon = kNoPolygon;  ///< number of the polygon of this ring, from 0 in a LineSet
  std::string name;                    ///< for messages: "shores.gpkg:lakes feature 12"
  LineKind kind = LineKind::kBreakline;

  bool is_ring() const { return role != LineRole::kLine; }
  /// True if this line adopts the height of hard lines that do not yield; it never causes a conflict.
  bool yields() const { return kind == LineKind::kRiver || kind == LineKind::kWall; }
};

inline bool is_wall(const Line& line) { return line.kind == LineKind::kWall; }
inline bool is_ridge_line(const Line& line) {
  return line.kind == LineKind::kRidge || line.kind == LineKind::kKeptRidge;
}

/// The content of a vector layer.
struct LineSet {
  std::vector<Line> lines;  ///< in the order of the layer; a polygon's outer ring precedes its holes
  std::string path, layer;  ///< their source, for messages
  std::string format;       ///< "GPKG", "GeoJSON", …
  std::string crs;          ///< CRS of the layer: "EPSG:32611", WKT, or empty
  std::uint32_t polygons = 0;
  std::vector<std::string> warnings;  ///< sentences for the user: omitted points, an unknown CRS
};

/// The height of a vertex where hard lines of different heights meet.
enum class LineConflict {
  kError,    ///< the call fails and names the lines
  kFirst,    ///< height of the line given first
  kMean,     ///< mean of all lines there
  kHighest,  ///< highest of all lines there
};

/// Breaklines: lines that become chains of edges of the mesh.
struct LineConstraints {
  std::vector<Line> lines;  ///< from read_lines(); includes rings of polygons. EMPTY: no constraints
  /// Map from samples to the coordinates of the lines, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  LineConflict conflict = LineConflict::kError;
};

/// Polygons that limit the surface to their interior and rings. Within a polygon, rings count even-odd: holes,
/// self-intersecting rings and bow-ties are allowed, and parts enclosed twice are outside.
struct Cutline {
  /// Rings of polygons, from read_lines() or close_rings(); their heights are ignored. EMPTY: no cut. Functions with a
  /// cutline fail with kInput for a vertex more than 2^41 samples away, and name it.
  std::vector<Line> rings;
  /// Map from samples to the coordinates of the rings, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
};

/// The breakline vertex, as given, farthest above or below the raster; distances of lines that are 0 everywhere count
/// tenfold.
struct FarthestLine {
  std::string name;         ///< name of the line; empty: no line has heights
  double distance = 0;      ///< in z units
  bool is_at_zero = false;  ///< all its heights are 0
};

// Functions to read lines and polygons from vector files, and to move the outlines of polygons.

struct ReadLinesOptions {
  /// The CRS of x and y, as RasterInfo::crs. DEFAULT: the layer's.
  std::string crs = {};
  /// The attribute with the height of a whole feature, such as a contour; features without a value are soft. DEFAULT:
  /// the third coordinate; lines without one are soft.
  std::string z_field = {};
  bool ignore_z = false;  ///< all lines are soft. DEFAULT: false.
  ProgressCallback progress = {};
  /// The unit of x and y in metres, if `crs` is empty: LandXML in another unit is rejected. DEFAULT: 0, unknown.
  double unit_in_metres = 0;
};

/// Reads the lines and polygons of one layer, by GDAL: GeoPackage, GeoJSON, Shapefile, FlatGeobuf, DXF, CSV with WKT, …
/// `path` is a file, a URL or a /vsi… name. A layer may follow a colon: "dem.gpkg:ridges". Without a layer name, the
/// file must have exactly one layer for lines or polygons. The layers of LandXML are surfaces. Their boundaries become
/// polygons without heights: outer boundaries and islands, with voids as holes.
///
/// Multilines, multipolygons and collections are split into their parts; arcs become chords of at most 4 degrees. x and
/// y are transformed vertex by vertex from the layer's CRS; between two vertices a line is straight in the requested
/// CRS. Heights do not change; NaN heights are interpolated between the other heights of the line. A layer without CRS
/// is assumed to be in the requested CRS. Points, features without geometry, and lines and rings of no extent are
/// omitted and counted. Warnings report all of this.
///
/// Error messages name the file, layer and feature. Fails with kInput for a missing file or layer, no suitable layer or
/// several (which are named), no lines in the layer, a coordinate that is not finite (z may be NaN: unknown), a vertex
/// without coordinates in the requested CRS, a missing attribute, or an attribute that is not a finite number; with
/// kUsage for a requested CRS unknown to GDAL; with kCancelled. Cost: a few tenths of a second for a million vertices
/// of a GeoPackage, a second with a transformation (bench/speed/speed_lines.cpp).
Result<LineSet> read_lines(const std::string& path, const ReadLinesOptions& options = {});
/// The lines of several files as one set, without path and CRS; polygons are numbered across files. Fails as
/// read_lines() for the first file that fails.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options = {});

/// Fails with kInput unless all lines are rings of polygons. The message names `user`, the option that needs polygons
/// ("--water"), and `otherwise`, the option that accepts lines ("--rivers"), unless empty.
Result<void> check_polygons(std::span<const Line> lines, const std::string& user, const std::string& otherwise = {});

/// Like read_lines(), with heights in the unit of the values in the file of `raster`, before its z_scale and z_offset.
/// Heights in another unit are converted, with a warning. Their unit is that in the name of their attribute
/// ("elev_ft"), else that of the layer's vertical CRS. Same failures and cost.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options,
                           const RasterInfo& raster);

/// The union of polygons, with its outline moved inwards by `distance`, outwards if negative. Corners that move away
/// become round, with arcs as chords of 90 / 8 degrees. `sample` is the side of a sample. Since edges far below a
/// sample need many tiny triangles, vertices that the outline does not need within a 256th of a sample and an eighth of
/// the distance are removed. For distances below a sample, corners remain pointed, at most twice as far away. `unit`:
/// the lengths of one unit of x and of y, in the unit of `distance`, above 0. The result may be empty: polygons
/// narrower than twice the distance vanish. Uses GDAL and GEOS, in double arithmetic. Fails with kUsage if the build
/// lacks one of them, with kInput if GEOS fails.
Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit = {1, 1}, double sample = 0);

// Cutlines: polygons at which the surface ends.

/// Returns rings unchanged, and closed lines as separate polygons. Fails with kInput for an open line, and names it.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

/// Result of mask_outside().
struct MaskedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< true if some cell of the grid has three or four heights within
  std::uint64_t bytes = 0;   ///< additional memory of the field's new source
};

/// Makes all samples outside the polygons nodata: a cut along the cells of the grid, for use where a cut along the
/// polygons is not possible. A field not in memory gets a source that masks samples on reading; the field is read once,
/// to count. If `info` has no range, it receives that of the heights before the cut. Fails as the field's source and
/// with kCancelled. REQUIRES: the affine map can be inverted. Cost: O(samples + segments · rows that they cross).
Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
