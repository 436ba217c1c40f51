// Inputs that can be read only once.
#pragma once

#include <string>

#include "scarp/result.h"

namespace scarp {

/// A name for what `path` names that any number of readers may open: the path itself; for "-" (standard input) and for
/// pipes that of a copy, made on the first call and kept for the process. The copy has no name in any folder, so
/// nothing is left of it however the process ends. Fails with kInput, and with kOutput where the copy has no room.
Result<std::string> readable_name(const std::string& path);

}  // namespace scarp
