// Copies of input that can be read only once.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/result.h"

namespace scarp::io {

/// A name that any number of readers may open for the input `path`. For "-" (standard input) and pipes it names a copy,
/// made on the first call and kept until the process ends; otherwise it is the path. The copy has no name in any
/// folder, so it vanishes with the process. Fails with kInput, and with kOutput if there is no space for the copy.
Result<std::string> readable_name(const std::string& path);

/// Stores bytes to be read again later. Returns a name for GDAL: a part of one unnamed file in the folder for temporary
/// files, kept until the process ends. Fails with kOutput if there is no space.
Result<std::string> spool_bytes(std::span<const std::uint8_t> bytes);

}  // namespace scarp::io
