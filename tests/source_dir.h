// The path of the sources, for tests that read their files.
#pragma once

#include <string>

namespace scarp {

/// The project's folder. Only this object contains a path: all others are independent of it.
std::string source_dir();

}  // namespace scarp
