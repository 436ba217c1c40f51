// The path of the sources, for tests that read files of theirs.
#pragma once

#include <string>

namespace scarp {

/// The project's folder. The only object that holds a path: all others are the same wherever it lies.
std::string source_dir();

}  // namespace scarp
