// The version of the library.
#pragma once

#define SCARP_VERSION "0.1.0"

namespace scarp {

/// "MAJOR.MINOR.PATCH" of the library that is linked.
const char* version();

}  // namespace scarp
