// The position of a mesh, and that of the raster that judges it.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The smallest box around something, in x and y.
struct Extent {
  std::array<double, 2> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::array<double, 2> high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(double x, double y);
  /// Area in common as a share of the area of both; 0 where they do not meet.
  double overlap(const Extent& other) const;
  /// "x 0 to 100 and y -20 to 80".
  std::string text() const;
};
Extent extent_of(const Mesh& mesh);
Extent extent_of(const HeightField& field);
Extent extent_of(const PointSet& points);

/// The raster's options, completed by the mesh's metadata where they were not given.
GivenOptions remember_options(const GivenOptions& given, const Mesh& mesh);
/// Turns a mesh whose file, `path`, does not declare which axis is up, if y is.
void turn_up(bool is_y_up, const std::string& path, Mesh& mesh);

/// For a mesh without metadata about its frame: the raster's own coordinates, if it fits the raster there better than
/// in the frame that was read. True where heights have become metres in that one and must be read anew, as "source".
bool fit_frame(const Mesh& mesh, OwnedHeightField& field);

/// For a mesh whose metadata give its position in numbers (`to_source`): the frame in which they hold for the samples,
/// in place of one around the raster's own centre, which may not be the mesh's. Returns warnings. Does nothing to
/// rasters without georeference, and where both frames are the same.
std::vector<std::string> place_frame(const Mesh& mesh, OwnedHeightField& field);

/// Why nothing can be judged: "it covers no sample of RASTER: …".
std::string describe_elsewhere(const Extent& mesh, const Extent& reference, const std::string& what);

}  // namespace scarp::cli
