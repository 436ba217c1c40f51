// Conversion of exceptions to errors at the public functions.
#pragma once

#include <string_view>

#include "scarp/result.h"

namespace scarp {

/// The Error of the current exception; call it in a `catch (...)` block. `doing` names the failed action, as in "read
/// dem.tif". If memory has run out: `kind`, with the message "not enough memory to read dem.tif". All other exceptions:
/// kInternal.
tl::unexpected<Error> caught(ErrorKind kind, std::string_view doing);

}  // namespace scarp
