// MD5 (RFC 1321): a table of names in .3tz archives is sorted by it. It protects nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace scarp {

std::array<std::uint8_t, 16> md5_of(std::string_view text);

}  // namespace scarp
