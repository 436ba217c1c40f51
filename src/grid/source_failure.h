// The error of a source of samples, where no Result can carry it.
#pragma once

#include "scarp/result.h"

namespace scarp {

/// Thrown by readers that answer with samples alone; simplify() and measure() turn it into their own error.
struct SourceFailure {
  Error error;
};

}  // namespace scarp
