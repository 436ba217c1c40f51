// Reproduce the greedy insertion of the 1995 paper, with its strategies.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     scarp::PaperOptions options;
//     options.goals.max_triangles = 1000;
//     options.strategy.importance.feature = scarp::Importance::Feature::kCurvature;
//     options.strategy.importance.damping = scarp::Importance::Damping::kPlusOne;
//     SCARP_TRY(const auto& made, scarp::simplify_by_paper(dem, options));
//     std::printf("max error %g\n", made.measurement.max_error);
#pragma once

#include <vector>

#include "scarp/height_field.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/simplify.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The goals, and the strategy to reach them. Strategies only insert vertices, in the greedy order. Use simplify() for
/// efforts above fast, lines and shapes.
struct PaperOptions {
  Goals goals = {};
  Tolerances tolerances = {};
  std::vector<SampleAt> points = {};  ///< see Features::points; for Terra's scripts
  Domain domain = {};
  Output output = {};
  Strategy strategy = {};
  Run run = {};
};

/// Inserts the worst samples of a field in memory (Garland & Heckbert 1995, Algorithms I to III, parallel insertion and
/// data-dependent triangulation). Guarantees, budgets and proof are those of simplify() with fast effort in the greedy
/// order; with the default strategy the mesh is the same, byte for byte.
///
/// Fails as simplify() does. Also fails with kUsage for a field without samples in memory, for Objective::kRms, and for
/// a strategy out of range: no importance, one pass with batches or without a feature of the raster, a batch fraction
/// not in (0, 1], a shape threshold above 1, supersampling below 0. Cost: that of simplify() in the greedy order; for
/// Algorithms I and II, as listed at Algorithm; about ten times as long with data-dependent edges.
Result<Simplified> simplify_by_paper(const HeightField& field, const PaperOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
