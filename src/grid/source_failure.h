// The error of a sample source, for functions that do not return a Result.
#pragma once

#include "scarp/result.h"

namespace scarp::grid {

/// Thrown by readers that return only samples; simplify() and measure() return its error.
struct SourceFailure {
  Error error;
};

}  // namespace scarp::grid
