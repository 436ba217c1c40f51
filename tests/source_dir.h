// The path of the sources, for tests that read their files.
#pragma once

#include <string>

namespace scarp {

/// The project's folder. Only this object file contains a path, so all others are independent of the folder.
std::string source_dir();

}  // namespace scarp
