// Exceptions end at the public doors.
#pragma once

#include <string_view>

#include "scarp/result.h"

namespace scarp {

/// The Error of the exception that is being handled; to be called in a `catch (...)` block. `doing` names what failed,
/// as in "read dem.tif". Memory that ran out: `kind`, "not enough memory to read dem.tif"; all else: kInternal.
tl::unexpected<Error> caught(ErrorKind kind, std::string_view doing);

}  // namespace scarp
