// Copies of input that can be read only once.
#pragma once

#include <cstddef>
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

/// Opens a file without a name in the folder for temporary files; the caller closes it. `what`: its content, for
/// messages. These functions fail with kOutput.
Result<int> open_scratch(const std::string& what);
Result<void> write_scratch(int file, std::uint64_t offset, std::span<const std::byte> bytes, const std::string& what);
/// REQUIRES: the bytes were written.
Result<void> read_scratch(int file, std::uint64_t offset, std::span<std::byte> bytes, const std::string& what);

}  // namespace scarp::io
