// Meshes drawn as surfaces in space: hidden parts, light and lines.
#pragma once

#include <array>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/mesh.h"

namespace scarp::paper {

/// The viewpoint of a picture of a surface, without perspective.
struct View {
  int width = 440;  ///< pixels
  /// Directions as (cosine, sine), so that pictures need no libm: how far the surface is turned, and how far above the
  /// horizon the eye is. DEFAULT: from the south-west, 37 degrees up. (0, 1) up: a map.
  std::array<double, 2> turn{0.8, 0.6}, up{0.8, 0.6};
  double relief = 0.2;    ///< height of the field's relief, in its longer sides; the light of a map depends on it, too
  double line_width = 0;  ///< width of edges, pixels. 0: none
};

/// The mesh, which lies in the field's frame, in light from the picture's upper left. The field decides what fits into
/// the picture: all meshes of a field have the same place and scale. Expected: a field in a frame without rotation, in
/// memory.
Picture draw_view(const OwnedHeightField& field, const Mesh& mesh, const View& view);

/// The field itself: two triangles a cell.
Mesh make_full_mesh(const OwnedHeightField& field);

}  // namespace scarp::paper
