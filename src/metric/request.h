// The request for a run of the engine.
#pragma once

#include <utility>

#include "scarp/paper.h"
#include "scarp/simplify.h"

namespace scarp {

/// The options of simplify(), or those of simplify_by_paper() with its strategy.
struct Request : SimplifyOptions {
  // NOLINTNEXTLINE(google-explicit-constructor): the engine accepts options as they are.
  Request(SimplifyOptions options) : SimplifyOptions(std::move(options)) {}
  explicit Request(const PaperOptions& options)
      : SimplifyOptions{.goals = options.goals,
                        .tolerances = options.tolerances,
                        .features = {.points = options.points},
                        .quality = {.effort = Effort::kFast, .order = Order::kGreedy},
                        .domain = options.domain,
                        .output = options.output,
                        .run = options.run},
        strategy(options.strategy) {}

  Strategy strategy;
  bool chose_effort = false;  ///< the effort was not asked for
};

inline bool has_budget(const SimplifyOptions& options) {
  return options.goals.max_triangles || options.goals.max_vertices;
}
inline bool has_lines(const SimplifyOptions& options) {
  return options.features.have_lines() || !options.features.cutline.rings.empty();
}

}  // namespace scarp
