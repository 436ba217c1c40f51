// Table of efforts, which determine the work after refinement.
#pragma once

#include <optional>

#include "fit/fit.h"
#include "scarp/options.h"

namespace scarp::pieces {

struct EffortTraits {
  bool fits = false;            ///< removes vertices
  bool moves_vertices = false;  ///< also moves vertices off their samples, if the options allow
  bool goes_on = false;         ///< continues until the time limit, if any
  fit::FitDepth depth = {};
  int exchanges = 0;                           ///< SquareGoal::exchanges
  std::optional<Effort> lower = std::nullopt;  ///< the next lower effort that may find a smaller mesh for shape goals
};

/// REQUIRES: not kAuto.
const EffortTraits& traits_of(Effort effort);

}  // namespace scarp::pieces
