// Gzip compression for tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp::io {

/// A gzip file of the bytes, without a time or a name. With one version of zlib, equal bytes give equal files.
Result<std::vector<std::uint8_t>> compress_gzip(std::span<const std::uint8_t> bytes);
/// Like compress_gzip(), for a mesh, whose numbers hardly repeat. Bytes are coded only by frequency. This needs a
/// twentieth of the time of a search for repetitions, and the files are not larger. If the result is so small that the
/// bytes must be repetitive, as for a flat tile, the search is also tried, and the smaller file is returned.
Result<std::vector<std::uint8_t>> compress_gzip_of_mesh(std::span<const std::uint8_t> bytes);
/// Decompresses a file. Fails with kInput if the file is not gzip, is damaged, or holds more than `most` bytes.
Result<std::vector<std::uint8_t>> decompress_gzip(std::span<const std::uint8_t> bytes, std::size_t most);
/// True for bytes that begin like a gzip file.
bool is_gzip(std::span<const std::uint8_t> bytes);

}  // namespace scarp::io

#pragma GCC visibility pop
