// Seeding: the triangulation of the domain before any refinement.
#pragma once

#include <cstdint>

#include "grid/outline.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp::refine {

struct DomainMesh {
  tin::Triangulation tin;
  bool whole = true;         ///< true: every sample is a height and the domain is the rectangle
  std::uint32_t unused = 0;  ///< rectangle corners that are not vertices of the domain (nodata or stray)
};

/// The rectangle as two triangles if every sample is a height. Else the outline's vertices, with constrained edges; all
/// other triangles are marked outside. In frames that are not affine, the border follows the samples
/// (follow_curved_border()). Fails with kInput if no cell is surface.
Result<DomainMesh> build_domain(const grid::Raster& raster, double outline_tolerance, const Frame& frame);

/// For a frame that is not affine: adds samples to the domain's border until each border edge, in the frame, is within
/// 1/512 sample of its samples.
void follow_curved_border(const grid::Raster& raster, tin::Triangulation& tin, const Frame& frame);

}  // namespace scarp::refine
