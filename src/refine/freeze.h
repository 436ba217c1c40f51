// From the workbench to the mesh that is given away.
#pragma once

#include "grid/raster.h"
#include "scarp/frame.h"
#include "scarp/mesh.h"
#include "tin/triangulation.h"

namespace scarp {

/// The triangles that are not outside, with the vertices they use, in the frame: offsets from frame_origin(), rounded
/// to float32 if asked, heights as they are. Counter-clockwise from above whatever way the frame turns. Ids follow the
/// order of insertion.
Mesh freeze(const Raster& raster, const Triangulation& tin, const Frame& frame, bool round_to_float32);

/// Unit normals of the full-resolution surface at lattice points, in the frame: central differences, one-sided beside
/// voids and borders; 3 values a point, z > 0.
std::vector<float> sample_normals(const Raster& raster, const Frame& frame, const std::vector<Point>& samples);

/// Places in the raster's image: pixel centres, (0, 0) the image's top left corner and (1, 1) its bottom right; 2
/// values a point.
std::vector<float> sample_uvs(const Raster& raster, const std::vector<Point>& samples);

/// The lattice points of freeze()'s vertices, in its order.
std::vector<Point> frozen_samples(const Triangulation& tin);

}  // namespace scarp
