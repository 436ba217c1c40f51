// Fitting on scattered points: the mesh of refinement gets smaller (fit/fit.h) while every point keeps the bound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "scarp/points.h"
#include "scarp/result.h"
#include "simplify/point_recipe.h"

namespace scarp {

/// The bounds on the way to a max error. Fitting reads heights as float32, whose rounding comes off the bound, as does
/// a share for that of positions. Where nothing is left, there is no fitting.
struct PointAims {
  double refinement = 0, fit = 0;

  PointAims(double max_error, std::span<const double> heights);
  bool is_open() const { return refinement > 0; }
};

struct PointFit {
  std::uint64_t removed = 0;
  bool is_cut_short = false;
};

/// Removes vertices, moves others where the effort does that, and brings the domain up to date. `fixed`: points whose
/// vertices stay, sorted. `heights`: of points as vertices. Fails with kCancelled. REQUIRES: every point keeps
/// aims.refinement; the lattice has kMaxFitSteps at most in what triangles reach over, or nothing is done there.
Result<PointFit> fit_points(const SnappedPoints& points, const PointSet& given, std::span<const double> heights,
                            const PointAims& aims, std::span<const std::uint32_t> fixed, const PointRecipe& recipe,
                            ScatteredDomain& domain);

}  // namespace scarp
