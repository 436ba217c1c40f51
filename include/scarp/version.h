// Find the version of the library with which a program is linked.
//
// Example:
//     std::printf("compiled for Scarp %s, linked with %s\n", SCARP_VERSION, scarp::version());
#pragma once

#define SCARP_VERSION "0.2.0"

#pragma GCC visibility push(default)

namespace scarp {

/// "MAJOR.MINOR.PATCH" of the linked library.
const char* version();

}  // namespace scarp

#pragma GCC visibility pop
