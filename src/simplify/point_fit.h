// Fitting on scattered points: the mesh of refinement gets smaller (fit/fit.h) while every point keeps the bound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "scarp/result.h"
#include "simplify/point_recipe.h"

namespace scarp {

struct PointFit {
  std::uint64_t removed = 0;
  bool is_cut_short = false;
};

/// Removes vertices, moves others where the effort does that, and brings the domain up to date. `fixed`: points whose
/// vertices stay, sorted. `heights`: of points as vertices. Fails with kCancelled. REQUIRES: every point keeps
/// recipe.aims.refinement; the lattice has kMaxFitSteps at most in what triangles reach over, or nothing is done there.
Result<PointFit> fit_points(const SnappedPoints& points, std::span<const double> heights,
                            std::span<const std::uint32_t> fixed, const PointRecipe& recipe, ScatteredDomain& domain);

}  // namespace scarp
