// MD5 (RFC 1321), for sorting the name table of .3tz archives. Not for security.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace scarp::io {

std::array<std::uint8_t, 16> md5_of(std::string_view text);

}  // namespace scarp::io
