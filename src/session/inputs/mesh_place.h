// The position of a mesh and of the raster that judges it.
#pragma once

#include <array>
#include <limits>
#include <optional>
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
  /// Common area as a share of the area of both; 0 if they are disjoint.
  double overlap(const Extent& other) const;
  /// "x 0 to 100 and y -20 to 80".
  std::string text() const;
};
Extent extent_of(const Mesh& mesh);
Extent extent_of(const HeightField& field);
Extent extent_of(const PointSet& points);

/// The six numbers of the mesh's metadata `to_source`; nothing if they are missing or malformed.
std::optional<std::array<double, 6>> read_to_source(const Mesh& mesh);
/// The map from places of `from` to places of `to`; both are maps of that form to the same coordinates.
std::array<double, 6> way_between(const std::array<double, 6>& from, const std::array<double, 6>& to);

/// The raster's options; the mesh's metadata supply those not given.
GivenOptions remember_options(const GivenOptions& given, const Mesh& mesh);
/// Turns a mesh that has y up, if the format of its file `path` does not declare the axis.
void turn_up(bool is_y_up, const std::string& path, Mesh& mesh);

/// For a mesh without metadata about its frame: switches to the raster's own coordinates if the mesh fits better there
/// than in the frame that was read. True if heights were converted to metres and must be read again as "source".
bool fit_frame(const Mesh& mesh, OwnedHeightField& field);

/// For a mesh whose metadata contain its position (`to_source`): uses the mesh's frame instead of a frame around the
/// raster's centre. Returns warnings. Does nothing for rasters without georeference or if both frames agree.
std::vector<std::string> place_frame(const Mesh& mesh, OwnedHeightField& field);

/// The reason why nothing can be judged: "it covers no sample of RASTER: …".
std::string describe_elsewhere(const Extent& mesh, const Extent& reference, const std::string& what);

}  // namespace scarp::cli
