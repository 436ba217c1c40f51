// One run of the engine on scattered points, as a list of passes: refine, chains of lines, fit, freeze, prove.
// Milestones: after `refine` and `take_best_prefix` no vertex is added; the returned mesh is the one that `prove`
// judged.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "grid/snapped_points.h"
#include "refine/point_lines.h"
#include "refine/scattered.h"
#include "scarp/points.h"
#include "scarp/result.h"
#include "simplify/point_recipe.h"
#include "simplify/wider_proof.h"

namespace scarp::run {

/// Points ready for runs. All referenced objects must stay alive.
struct PointTask {
  const PointSet& points;
  const grid::SnappedPoints& snapped;
  const std::vector<double>& heights;  ///< heights of points as vertices: z, perhaps rounded to float32
  const refine::PointLines& lines;
  grid::PointSteps steps;
  /// The subject of the error for a budget that the least mesh exceeds.
  std::string least(const PointOptions& options) const {
    const bool has_zeros =
        std::find(options.tolerances.begin(), options.tolerances.end(), 0) != options.tolerances.end();
    const std::string zeros = has_zeros ? " and the points with a tolerance of 0" : "";
    if (!points.lines.empty()) return "the lines and the outline of the points" + zeros + " alone need";
    if (options.quality.shape.any()) return "the angles and edges" + zeros + " alone need";
    const char* const outline = points.boundary.empty() ? "the hull of the points" : "the boundary";
    return outline + zeros + (has_zeros ? " alone need" : " alone needs");
  }
  double width;  ///< width of the hull: ScatteredDomain::width
  /// The proof at more points, which may join these; null: these are all.
  WiderProof* proof = nullptr;
};

struct PointFacts {
  std::uint64_t flat = 0, loose = 0;  ///< those of SimplifiedPoints
};

struct PointMesh {
  Simplified simplified;
  PointFacts facts = {};
};

/// Makes one mesh: towards the max error, or until insertion reaches a budget. Fails like simplify_points(). REQUIRES:
/// the domain has the ends of lines as vertices.
Result<PointMesh> run_points(const PointTask& task, const PointRecipe& recipe, refine::ScatteredDomain domain);

}  // namespace scarp::run
