// The domain: the part of the grid that is surface.
//
// A grid cell with four valid corner samples is surface. A cell with three valid corners is surface in the triangle
// between them. Any other cell is nodata. The outline of the surface is a set of closed lattice polygons.
#pragma once

#include <span>
#include <vector>

#include "grid/raster.h"
#include "grid/sample_runs.h"

namespace scarp::grid {

/// Closed polygons with the domain on their left: outer borders have positive orientation, holes negative. Polygons
/// never cross. They may touch themselves and each other in single points, which are then vertices of all polygons
/// there. No other vertex is collinear with its neighbours.
using Outline = std::vector<std::vector<Point>>;

/// True if every sample is a height. Cost: O(samples).
bool is_whole(const Raster& raster);

/// Traces the outline. Empty if no cell is surface. Deterministic. Cost: O(samples + L log L) for an outline of L unit
/// edges.
Outline trace_outline(const Raster& raster);

/// The outline of these samples only, as if all others were nodata. `runs`: in raster order, disjoint. Cost: O(samples
/// + L log L). Memory: proportional to L and a row, not to the samples.
Outline trace_outline(std::span<const SampleRun> runs);

/// The valid corners of the cell [x, x+1] × [y, y+1]: bit k for corner k of (x,y), (x+1,y), (x+1,y+1), (x,y+1).
inline unsigned valid_corners(const Raster& raster, std::int32_t x, std::int32_t y) {
  const auto bit = [&](std::int32_t i, std::int32_t j, unsigned k) { return raster.is_valid({i, j}) ? 1u << k : 0u; };
  return bit(x, y, 0) | bit(x + 1, y, 1) | bit(x + 1, y + 1, 2) | bit(x, y + 1, 3);
}

/// Closes (makes surface) the voids that contain no height and lie entirely within `tolerance` samples of their
/// outline. REQUIRES: an outline from trace_outline(). Cost: O(L) for small voids.
Outline close_voids(const Raster& raster, Outline outline, double tolerance);

/// Simplifies the polygons so that each point of the old outline lies within `tolerance` samples of the new one. The
/// domain only grows, and only over nodata samples. No valid sample is cut off or newly enclosed, and polygons still do
/// not cross. Vertices are a subset of the old ones and include those where polygons touch. Cost: O(L · tolerance) on
/// typical outlines.
Outline simplify_outline(const Raster& raster, const Outline& outline, double tolerance);

}  // namespace scarp::grid
