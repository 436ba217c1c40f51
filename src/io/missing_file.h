// The sentence about a file that is not there.
#pragma once

#include <string>

namespace scarp {

/// "no such file", and what its folder holds that is like it: another ending, or a typo.
std::string describe_missing(const std::string& path);

}  // namespace scarp
