// The version of the library.
#pragma once

#define SCARP_VERSION "0.2.0"

#pragma GCC visibility push(default)

namespace scarp {

/// "MAJOR.MINOR.PATCH" of the library that is linked.
const char* version();

}  // namespace scarp

#pragma GCC visibility pop
