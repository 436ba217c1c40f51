// The parameters of a run of the engine.
#pragma once

#include <utility>

#include "scarp/options.h"

namespace scarp::metric {

/// The options of simplify(), or those of simplify_by_paper() with its strategy.
struct Request : SimplifyOptions {
  // NOLINTNEXTLINE(google-explicit-constructor): the engine accepts options as they are.
  Request(SimplifyOptions options) : SimplifyOptions(std::move(options)) {}

  Strategy strategy;
  bool chose_effort = false;  ///< true: the effort was chosen by default
};

inline bool has_budget(const SimplifyOptions& options) {
  return options.goals.max_triangles || options.goals.max_vertices;
}
inline bool has_lines(const SimplifyOptions& options) {
  return options.features.have_lines() || !options.features.cutline.rings.empty();
}

}  // namespace scarp::metric
