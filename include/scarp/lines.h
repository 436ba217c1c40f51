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
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"

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

// Reads lines and polygons from vector files, and moves the outlines of polygons.

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

/// read_lines(), with heights like the values in the file of `raster`, before its z_scale and z_offset: where the name
/// of their attribute ("elev_ft"), else the vertical CRS of the layer names their unit, and it is another one, they are
/// converted, and a warning reports it. Same failures and cost.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options,
                           const RasterInfo& raster);

/// The union of polygons, with its outline moved inwards by `distance`, outwards if negative. Corners that move away
/// become round, with arcs as chords of 90 / 8 degrees. Given the side of a `sample`, vertices that the outline does
/// not need are removed, within a 256th of it and an eighth of the distance, and distances below it keep corners
/// pointed, at most twice as far away: edges far below a sample would ask for many tiny triangles. `unit`: lengths of
/// the coordinates' units along x and y in the unit of the distance, above 0. The result may be empty: polygons
/// narrower than twice the distance vanish. By GDAL and GEOS, in double arithmetic; fails with kUsage in a build
/// without one of them, with kInput where GEOS fails.
Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit = {1, 1}, double sample = 0);

// Cutlines: polygons at which the surface ends.

/// Rings as they are, and closed lines as polygons of their own. Fails with kInput for an open line, and names it.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

/// Result of mask_outside().
struct MaskedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< some cell of the grid has three or four heights within
  std::uint64_t bytes = 0;   ///< additional memory of the field's source from now on
};

/// Makes all samples outside the polygons nodata: a cut along the cells of the grid, where a cut along the polygons
/// themselves is not possible. For a field that is not in memory the samples are nodata from now on whenever they are
/// read; the field is read once, to count. Then `info` has the range of the heights before the cut, if it had none.
/// Fails as the field's source and with kCancelled. REQUIRES: the affine map can be inverted. Cost: O(samples +
/// segments · rows that they cross).
Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
