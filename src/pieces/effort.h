// The efforts: the work that follows refinement, in one table.
#pragma once

#include <optional>

#include "fit/fit.h"
#include "scarp/options.h"

namespace scarp {

struct EffortTraits {
  bool fits = false;            ///< vertices are removed
  bool moves_vertices = false;  ///< and leave their samples, where they may
  bool goes_on = false;         ///< until a limit of the time, if there is one
  FitDepth depth = {};
  int exchanges = 0;                           ///< SquareGoal::exchanges
  std::optional<Effort> lower = std::nullopt;  ///< the next lower effort that may find a smaller mesh for shapes
};

/// REQUIRES: not kAuto.
const EffortTraits& traits_of(Effort effort);

}  // namespace scarp
