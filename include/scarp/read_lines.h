// Reads lines and polygons from vector files, and moves the outlines of polygons.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/progress.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

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

}  // namespace scarp

#pragma GCC visibility pop
