// What a cutline asks of a height field: rings that end at the raster, samples on both sides, the void beyond.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"
#include "grid/raster.h"
#include "refine/cut_away.h"
#include "scarp/cutline.h"
#include "scarp/lines.h"

namespace scarp {

/// The rings, clipped to the rectangle of the samples: closed still, along its sides where they leave it (I. E.
/// Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping", 1974). Those that lie in it stay as they are.
std::vector<Line> clip_rings(const Cutline& cutline, std::int32_t cols, std::int32_t rows);

/// On which side of a cut the samples lie. `walls`: pairs of points in kLatticeSteps, the edges at which a polygon or
/// its complement ends, complete within the raster's rectangle up to its sides; which side stays is not looked at.
std::vector<CutSide> sides_of_samples(std::span<const std::array<Point, 2>> walls, std::int32_t cols,
                                      std::int32_t rows);

/// Makes samples void (NaN) that no cell near the cut surface has: those of the cells that it lies in or touches stay,
/// and those of the cells around them, so that heights between samples and normals are what they were. Returns false if
/// there is no surface in the first. `samples`: the raster's, row-major.
bool void_beyond(std::span<const std::array<Point, 2>> walls, std::span<const CutSide> sides, std::int32_t cols,
                 std::int32_t rows, std::span<float> samples);

}  // namespace scarp
