// Why the system refused a file.
#pragma once

#include <string>

namespace scarp {

/// The end of a sentence, of an errno.
std::string reason_of(int error);

}  // namespace scarp
