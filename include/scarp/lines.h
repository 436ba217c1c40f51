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

/// The treatment of a line in a mesh (Features::breaklines).
enum class LineKind : std::uint8_t {
  kBreakline,  ///< remains a chain of edges
  kRiver,      ///< like kBreakline, but yields to other lines
  /// Lines of the following kinds are found in the raster. Like all other lines, they are inserted before greedy
  /// refinement of the surface. Efforts above kFast may change edges and remove vertices of kWall and kRidge lines.
  /// With free vertices, these efforts may also move vertices. Effort kHigh with vertices on samples does not change
  /// these lines.
  kWall,       ///< along the top or foot of a wall (detect_cliffs()): yields, and never changes a sample
  kRidge,      ///< a ridge or valley (detect_ridges()) whose edges may change
  kKeptRidge,  ///< a ridge or valley whose edges remain
};

struct Line {
  /// x, y, z; at least two points; successive points differ. x and y are finite. z is finite (hard line) or NaN, an
  /// unknown height (soft line). A ring has at least four points; the last equals the first.
  std::vector<std::array<double, 3>> points;
  LineRole role = LineRole::kLine;
  std::uint32_t polygon = kNoPolygon;  ///< number of the polygon of this ring, from 0 in a LineSet
  std::string name;                    ///< for messages: "shores.gpkg:lakes feature 12"
  LineKind kind = LineKind::kBreakline;

  bool is_ring() const { return role != LineRole::kLine; }
  /// True if this line adopts the height of hard lines that do not yield. Such a line never causes a conflict.
  bool yields() const { return kind == LineKind::kRiver || kind == LineKind::kWall; }
};

inline bool is_wall(const Line& line) { return line.kind == LineKind::kWall; }
inline bool is_ridge_line(const Line& line) {
  return line.kind == LineKind::kRidge || line.kind == LineKind::kKeptRidge;
}

struct LineSet {
  std::vector<Line> lines;  ///< in the order of the layer; a polygon's outer ring precedes its holes
  std::string path, layer;  ///< source of the lines, for messages
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

/// Polygons that limit the surface to their interior and rings. Within a polygon, rings follow the even-odd rule:
/// holes, self-intersecting rings and bow-ties are allowed, and parts enclosed twice are outside.
struct Cutline {
  /// Rings of polygons, from read_lines() or close_rings(); their heights are ignored. EMPTY: no cut. Functions that
  /// use a cutline fail with kInput for a vertex more than 2^41 samples away, and name the vertex.
  std::vector<Line> rings;
  /// Map from samples to the coordinates of the rings, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
};

/// The given breakline vertex farthest above or below the raster. For lines whose heights are all 0, distances count
/// tenfold.
struct FarthestLine {
  std::string name;         ///< name of the line; empty: no line has heights
  double distance = 0;      ///< in z units
  bool is_at_zero = false;  ///< all its heights are 0
};

// Reading lines, and moving the outlines of polygons.

struct ReadLinesOptions {
  /// The CRS of x and y, as RasterInfo::crs. DEFAULT: the CRS of the layer.
  std::string crs = {};
  /// The attribute with the height of a whole feature, such as a contour; features without a value are soft. DEFAULT:
  /// the third coordinate; lines without third coordinates are soft.
  std::string z_field = {};
  bool ignore_z = false;  ///< all lines are soft. DEFAULT: false.
  ProgressCallback progress = {};
  /// The unit of x and y in metres, if `crs` is empty: LandXML in another unit is rejected. DEFAULT: 0, unknown.
  double unit_in_metres = 0;
};

/// Reads the lines and polygons of one layer, by GDAL: GeoPackage, GeoJSON, Shapefile, FlatGeobuf, DXF, CSV with WKT, …
/// `path` is a file, a URL or a /vsi… name. The name of a layer may follow after a colon: "dem.gpkg:ridges". Without a
/// layer name, the file must have exactly one layer for lines or polygons. The layers of LandXML are surfaces. Their
/// boundaries become polygons without heights: outer boundaries and islands, with voids as holes.
///
/// Multilines, multipolygons and collections are split into their parts; arcs become chords of at most 4 degrees. x and
/// y are transformed vertex by vertex from the layer's CRS; between two vertices a line is straight in the requested
/// CRS. Heights do not change; NaN heights are interpolated between known heights of the line. A layer without CRS is
/// assumed to be in the requested CRS. Points, features without geometry, and lines and rings of zero extent are
/// omitted and counted. Warnings report these cases.
///
/// Error messages name the file, layer and feature. Fails with kInput for a missing file or layer, no or several
/// suitable layers (the message names them), a layer without lines, a coordinate that is not finite (z may be NaN:
/// unknown), a vertex without coordinates in the requested CRS, a missing attribute, or an attribute that is not a
/// finite number. Fails with kUsage for a requested CRS unknown to GDAL, and with kCancelled. Cost: a few tenths of a
/// second for a million vertices of a GeoPackage, a second with a transformation (bench/speed/speed_lines.cpp).
Result<LineSet> read_lines(const std::string& path, const ReadLinesOptions& options = {});
/// Reads lines of several files into one set, whose path and CRS are empty. Polygons are numbered across files. Fails
/// with the error of the first file that fails.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options = {});

/// Fails with kInput unless all lines are rings of polygons. The message names `user`, the option that needs polygons
/// ("--water"), and `otherwise`, the option that accepts lines ("--rivers"), if not empty.
Result<void> check_polygons(std::span<const Line> lines, const std::string& user, const std::string& otherwise = {});

/// Like read_lines(), with the same errors and cost, but heights are in the unit of the values in `raster`'s file,
/// before z_scale and z_offset. Heights in another unit are converted, with a warning. The unit is read from the name
/// of the attribute ("elev_ft"), else from the layer's vertical CRS.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options,
                           const RasterInfo& raster);

/// Returns the union of polygons, with its outline moved inwards by `distance`, or outwards if negative. Corners whose
/// edges move apart become arcs, made of chords of 90 / 8 degrees. `sample` is the side of a sample. Edges much shorter
/// than a sample need many tiny triangles, so vertices are removed where this moves the outline by at most 1/256 sample
/// and 1/8 of the distance. For distances below a sample, corners remain pointed, and move by at most twice the
/// distance. `unit`: the lengths of one unit of x and of y, in the unit of `distance`, above 0. The result may be
/// empty: polygons narrower than twice the distance vanish. Uses GDAL and GEOS, in double arithmetic. Fails with kUsage
/// if the build lacks GDAL or GEOS, with kInput if GEOS fails.
Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit = {1, 1}, double sample = 0);

// Cutlines: polygons at which the surface ends.

/// Returns rings unchanged, and closed lines as separate polygons. Fails with kInput for an open line, and names the
/// line.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

struct MaskedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< true if any cell of the grid has three or four heights within
  std::uint64_t bytes = 0;   ///< additional memory of the field's new source
};

/// Makes all samples outside the polygons nodata: a cut along grid cells, for use where a cut along the polygons is not
/// possible. A field with a source is read once, and gets a source that masks samples when they are read. If field.info
/// has no range, it receives the range of the heights before the cut. Fails with kCancelled, and with the errors of the
/// field's source. REQUIRES: the affine map can be inverted. Cost: O(samples + rows that each segment crosses).
Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
