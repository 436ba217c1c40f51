// Table of efforts, which determine the work after refinement.
#pragma once

#include <optional>

#include "fit/fit.h"
#include "scarp/options.h"

namespace scarp::pieces {

struct EffortTraits {
  bool fits = false;            ///< removes vertices
  bool moves_vertices = false;  ///< also moves vertices off their samples, unless the options forbid it
  bool goes_on = false;         ///< continues until the time limit, if any
  fit::FitDepth depth = {};
  int exchanges = 0;                           ///< SquareGoal::exchanges
  std::optional<Effort> lower = std::nullopt;  ///< the next lower effort that may find a smaller mesh for shape goals
};

/// True if vertices may move off their samples.
inline bool may_free(const EffortTraits& traits, Vertices vertices) {
  return vertices == Vertices::kAuto ? traits.moves_vertices : traits.fits && vertices == Vertices::kFree;
}

/// The default floor of shapes. With vertices on samples, a floor costs up to 10 % more triangles, possibly more than
/// normal effort.
inline double usual_shape(const EffortTraits& traits, bool frees_vertices) {
  return frees_vertices && traits.depth.rounds > 0 ? 0.1 : 0;
}

/// REQUIRES: not kAuto.
const EffortTraits& traits_of(Effort effort);

}  // namespace scarp::pieces
