// Scattered samples as values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/height_field.h"

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

/// How the convex hull fits points.
struct HullFit {
  double bridged = 0;          ///< share of its area that lies across bays, where no points are
  std::uint64_t slivers = 0;   ///< long steep triangles at it, where the points' rim is nearly straight
  double boundary_length = 0;  ///< for a mesh that ends at the points instead; 0: the hull fits
};

}  // namespace scarp

#pragma GCC visibility pop
