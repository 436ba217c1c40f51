// The system's reason for a file error.
#pragma once

#include <string>

namespace scarp::io {

/// An errno as the end of a sentence.
std::string reason_of(int error);

}  // namespace scarp::io
