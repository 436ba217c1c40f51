// The error of a sample source, where no Result can carry it.
#pragma once

#include "scarp/result.h"

namespace scarp {

/// Thrown by readers that return only samples; simplify() and measure() return its error.
struct SourceFailure {
  Error error;
};

}  // namespace scarp
