// Seeding: the triangulation of the domain before any refinement.
#pragma once

#include <cstdint>

#include "grid/outline.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

struct DomainMesh {
  Triangulation tin;
  bool whole = true;         ///< every sample is a height: the domain is the rectangle
  std::uint32_t unused = 0;  ///< rectangle corners that are no vertex of the domain (nodata or stray)
};

/// The rectangle as two triangles if every sample is a height; else the outline's vertices, its edges constrained, all
/// else marked outside. In frames that are not affine the border follows the samples (follow_curved_border()).
/// Fails with kInput if no cell is surface.
Result<DomainMesh> build_domain(const Raster& raster, double outline_tolerance, const Frame& frame);

/// In a frame that is not affine: adds samples to the domain's border until each border edge runs, in the frame, within
/// 1/512 sample of the samples under it.
void follow_curved_border(const Raster& raster, Triangulation& tin, const Frame& frame);

}  // namespace scarp
