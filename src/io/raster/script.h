// Decoding of scripts in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/io.h"

namespace scarp::io {

/// See read_script(); `name` is for messages.
Result<Script> decode_script(std::span<const std::uint8_t> bytes, const std::string& name, int cols, int rows);

}  // namespace scarp::io
