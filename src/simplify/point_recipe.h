// The recipe of a run on scattered points: decisions that follow from its options, made once.
#pragma once

#include <algorithm>
#include <cstdint>

#include "grid/snapped_points.h"
#include "pieces/recipe.h"
#include "scarp/points.h"
#include "scarp/result.h"

namespace scarp::run {

/// Fails with kUsage if there is no goal, a number is out of range, or options exclude each other.
Result<void> check_point_options(const PointSet& points, const PointOptions& options);

/// The bounds of passes towards a max error. Fitting reads heights as float32; the rounding of heights and a share for
/// the rounding of positions are subtracted from the bound. If no bound remains, there is no fitting.
struct PointAims {
  double refinement = 0, fit = 0;

  /// `largest`: the largest magnitude of a height.
  PointAims(double max_error, double largest);
  bool is_open() const { return refinement > 0; }
};

/// REQUIRES: checked options.
struct PointRecipe {
  PointRecipe(const PointSet& points, const PointOptions& asked, const pieces::Scale& scale = {});

  /// The bound of a point of the set; REQUIRES: tolerances and a max error.
  double bound_of(std::uint32_t source) const {
    return std::min(*options.max_error, double{options.tolerances[source]});
  }

  PointOptions options;
  pieces::Scale scale;
  double largest;               ///< the largest magnitude of a height
  Effort effort;                ///< never kAuto
  pieces::EffortTraits traits;  ///< the work of that effort
  PointAims aims;               ///< without a max error, those for 0
  bool removes;                 ///< vertices are removed after refinement
  bool insertion_stops;         ///< insertion can stop at budgets (BudgetTask)
  pieces::Search search;        ///< for the mesh of a budget
  bool frees_vertices;          ///< vertices may move off the points
  bool removes_last;       ///< vertices are removed after those for angles and edges, whose goals removal preserves
  grid::PointSteps steps;  ///< lattice of the points
};

}  // namespace scarp::run
