// The error message for a missing file.
#pragma once

#include <string>

namespace scarp::io {

/// "no such file", plus names in its folder that differ only by the extension or a typo.
std::string describe_missing(const std::string& path);

}  // namespace scarp::io
