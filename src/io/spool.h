// Inputs that can be read only once.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/result.h"

namespace scarp {

/// A name for what `path` names that any number of readers may open: the path itself; for "-" (standard input) and for
/// pipes that of a copy, made on the first call and kept for the process. The copy has no name in any folder, so
/// nothing is left of it however the process ends. Fails with kInput, and with kOutput where the copy has no room.
Result<std::string> readable_name(const std::string& path);

/// A place for bytes that are read again later: what GDAL opens them by, a part of one file without a name in the
/// folder for temporary files, kept for the process. Fails with kOutput where it has no room.
Result<std::string> spool_bytes(std::span<const std::uint8_t> bytes);

}  // namespace scarp
