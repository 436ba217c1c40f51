// Fitting on scattered points: reduces the mesh of refinement (fit/fit.h) while every point satisfies the bound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "scarp/result.h"
#include "simplify/point_recipe.h"

namespace scarp::run {

struct PointFit {
  std::uint64_t removed = 0;
  bool is_cut_short = false;
};

/// Removes vertices, moves others if the effort does so, and updates the domain. `fixed`: sorted points whose vertices
/// stay. `heights`: heights of points as vertices. Fails with kCancelled. REQUIRES: every point satisfies
/// recipe.aims.refinement. Triangles wider than kMaxFitSteps of the lattice do not change.
Result<PointFit> fit_points(const grid::SnappedPoints& points, std::span<const double> heights,
                            std::span<const std::uint32_t> fixed, const PointRecipe& recipe,
                            refine::ScatteredDomain& domain);

}  // namespace scarp::run
