// Scattered samples: the same job where the heights do not lie on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/progress.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/simplify.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A line through points of a set: a contour, a ridge, the foot of a dam.
struct PointLine {
  std::vector<std::uint32_t> points;  ///< indices; at least two, successive ones differ; a ring ends with its first
  std::string name;                   ///< for messages: "contours.gpkg feature 12"
};

/// Samples anywhere: z over (x, y), in one plane coordinate system. x east, y north.
struct PointSet {
  std::vector<double> x, y, z;   ///< coordinates, of equal size; all finite
  std::vector<PointLine> lines;  ///< lines that no triangle crosses. EMPTY: the points are scattered
  std::string path;              ///< their source, for messages
  std::string format;            ///< "CSV", "GPKG", …
  std::string crs;               ///< CRS of x and y: "EPSG:32611", WKT, or empty
  std::string description;       ///< one line for reports: what x and y are, and in which unit
  bool is_local = false;         ///< x and y are metres around the middle of the points
  double unit_in_metres = 0;     ///< unit of x and y; 0 for degrees, and where it is unknown
  /// Known facts about z, like those about a raster's heights: unit, unit_in_metres, unit_is_assumed, file_unit,
  /// z_scale, z_offset; and crs_unit, crs_unit_in_metres of x and y in the file.
  RasterInfo heights = {};
  std::vector<std::string> warnings;
  std::string columns;               ///< one line for reports: how each column was read, or where heights come from
  std::uint64_t without_height = 0;  ///< number omitted, as ReadPointsOptions::nodata asks
  bool is_geographic = false;        ///< for points that are lent: without a CRS that GDAL knows, x and y are degrees

  std::size_t size() const { return x.size(); }
};

/// Rule for several points at one place: with equal x and equal y as given.
enum class DuplicatePolicy { kFirst, kLast, kHighest, kLowest, kMean };

struct ReadPointsOptions {
  std::string layer = {};  ///< layer of a vector file. DEFAULT: the first one with points, else with lines.
  /// Column or attribute with the height. DEFAULT: the third coordinate, unless it is 0 everywhere and an attribute has
  /// one of the names z, height, elevation, elev, h, alt, ele, hoehe …; where there is none, that attribute.
  std::string z_field = {};
  std::string crs =
      {};  ///< like ReadOptions::crs, "source" and "local" and a CRS; DEFAULT: local metres for degrees, else source
  ProgressCallback progress = {};
  /// The contents of a text's columns: "number,northing,easting,height,code", or as letters "pnezd"; - for one that is
  /// not read. DEFAULT: the names in the header, else guessed from the columns.
  std::string columns = {};
  /// Points of this height have none, nor have those whose height is empty or no finite number: they are omitted and
  /// counted. NaN: only the latter. DEFAULT: the call fails where a height is missing.
  std::optional<double> nodata = {};
  /// Heights and their unit, as in ReadOptions. DEFAULT of z_unit: the unit in the name of the column or attribute
  /// ("elev_ft", "Elevation (mm)"), else the vertical CRS, else the unit of x and y.
  double z_scale = 1, z_offset = 0;
  std::string z_unit = {};
  HeightsIn heights_in = HeightsIn::kFrame;
  /// kLocal, for points without a chosen `crs`: x and y whose unit is not the metre become local metres; others stay,
  /// and the caller moves them to local_origin(): their frame is a local one, too, for `heights_in`.
  DefaultFrame default_frame = DefaultFrame::kMetric;
};

/// Reads points: text of columns (CSV, XYZ: separated by commas, semicolons, tabs or blanks; decimal commas where
/// commas do not separate; a header line names them, else the first three are x, y, z, without a first one that counts;
/// lines that begin with #, % or // are comments), by a reader of our own; all else (GeoPackage, GeoJSON, Shapefile, …)
/// by GDAL. Where neither the header of a text nor its values show which column is the northing, the call fails and
/// names `columns`. The vertices of lines are points, too, and PointSet::lines has their order: contours with the
/// height as an attribute or as third coordinate. Curves become chords of 4 degrees at most. Fails with kInput:
/// missing, empty, a line without three numbers, a value that is not finite, a feature without a height (names the line
/// or feature), polygons, neither points nor lines in the layer.
Result<PointSet> read_points(const std::string& path, const ReadPointsOptions& options = {});

/// True if `path` names points rather than a raster: by its end (.csv .tsv .xyz .geojson .geojsonl .shp .fgb .gml .kml
/// .parquet; .txt and .dat unless they begin as an ASCII grid does; .gpkg unless it holds a raster), in any case. Text
/// of columns is a raster where its points are the nodes of one, in any order, with or without some missing: none lies
/// off the lattice or on another, two of three have one next to them in both directions, and they are a twentieth of
/// all nodes at least.
bool is_point_file(const std::string& path);

/// The middle of the points' extent, rounded so coarsely that offsets from it are exact: the origin of a local frame.
/// REQUIRES: some points, finite.
std::array<double, 2> local_origin(const PointSet& points);

/// How the convex hull fits points.
struct HullFit {
  double bridged = 0;          ///< share of its area that lies across bays, where no points are
  std::uint64_t slivers = 0;   ///< long steep triangles at it, where the points' rim is nearly straight
  double boundary_length = 0;  ///< for a mesh that ends at the points instead; 0: the hull fits
};

struct SimplifiedPoints {
  Simplified simplified;         ///< measurement: errors at the points as given; `samples` counts points
  std::uint64_t points = 0;      ///< number given
  std::uint64_t duplicates = 0;  ///< number of points given up for another at their place (equal x and y)
  std::uint64_t on_hull = 0;     ///< corners of the hull, convex or concave
  double lattice_step = 0;       ///< step of the integer lattice, in units of x and y
  std::uint64_t flat = 0;        ///< triangles whose corners lie on lines at one height
  std::uint64_t loose = 0;       ///< pieces of lines that are no edges, since they cross others of their height
  HullFit hull_fit;              ///< without boundary_length and lines
};

/// The goals, and how to reach them. At least one of the goals; the first that is reached ends the run.
struct PointOptions {
  /// |mesh − z| <= max_error at every point, finite and at least 0. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds, as in SimplifyOptions with fast effort. DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// Round positions to float32, as GLB and STL hold them; else they are double. DEFAULT: true.
  bool float32_positions = true;
  /// False: a budget that ends the run returns the last mesh, though an earlier one may have been better. DEFAULT:
  /// true.
  bool best_of_budget = true;
  DuplicatePolicy duplicates = DuplicatePolicy::kFirst;  ///< DEFAULT: the first point of each place.
  /// Above 0, in units of x and y: the mesh ends at a concave hull, whose edges are up to this long where the points
  /// hang together without longer ones. DEFAULT: at the convex hull.
  std::optional<double> boundary_length = std::nullopt;
  Run run = {};  ///< threads, of the proof, and progress
};

/// Greedy insertion on scattered samples (section 2 of the 1995 paper names it, without doing it). The domain is the
/// convex hull, or with `boundary_length` the chi-shape of Duckham et al. (2008): of the Delaunay triangulation of all
/// points, triangles whose edge on the boundary is longer go, the longest edge first, as long as the domain stays
/// connected, its boundary a simple polygon, and every point in it. All corners of that polygon are vertices. Each
/// triangle keeps the list of the points in it. Coordinates are snapped to an integer lattice of up to 2^30 steps: the
/// coarsest on which the given decimals lie exactly if there is one, else the finest power of two. Different points are
/// never merged: where the lattice cannot keep two apart, they are refused. Among points of equal error the one in the
/// northernmost, then westernmost place is inserted. Points on a grid give the vertices that simplify() gives for the
/// raster, but for ties.
///
/// A line becomes a chain of edges through some of its points, among them its ends, of a ring at least three. Chains do
/// not cross, so no triangle crosses one; what the line has between two points of its chain is within max_error of the
/// mesh. Triangles between points of equal height on lines, as in the bend of a contour, are given up by flips of edges
/// where the other points allow it; the rest is counted (`flat`). Points of lines that the lattice cannot keep apart
/// share a vertex, and count all the same.
///
/// Guarantees that |mesh − z| <= max_error at every point that is not given up as a duplicate, at its coordinates as
/// given, for the positions as they are in the mesh. Vertices are points.
/// Fails with kUsage (no goal, a max_error out of range, a budget below what the hull needs, a boundary_length that is
/// not above 0, a budget or a boundary_length with lines), with kInput (lines that meet with unlike heights, which are
/// named, fewer than 3 places, all on one line, a value that is not finite or beyond 1e100, an extent below 1e-100, two
/// points nearer to each other than about 2^-30 of the extent, which are named, as is the far point that makes the
/// extent so large), with kPromise where float32 positions cannot keep the bound, kCancelled. Cost: expected O(n log m)
/// for n points, with boundary_length O(n log n); about 50 bytes a point in addition to the points themselves.
Result<SimplifiedPoints> simplify_points(const PointSet& points, const PointOptions& options);

/// Judges a mesh against points by brute force, without knowing how it was made: Measurement::samples counts points,
/// max_error_at is {index of the point, 0}, and so are offenders; on_row is called once, with all points. Duplicates
/// are given up by the same policy first. coverage_tolerance counts mean distances between points, √(area / points).
/// Gaps are open edges within the convex hull, but see MeasureOptions::inlets. Same failures and cost as measure();
/// kUsage for MeasureOptions::tolerance; kInput for points that simplify_points() cannot keep apart.
Result<Measurement> measure_points(const PointSet& points, const Mesh& mesh, DuplicatePolicy duplicates,
                                   const MeasureOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
