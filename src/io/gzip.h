// Gzip compression for tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The bytes in a gzip file without a time or a name: equal bytes give equal files, with one version of zlib.
Result<std::vector<std::uint8_t>> compress_gzip(std::span<const std::uint8_t> bytes);
/// The same for a mesh, whose numbers hardly repeat. Bytes are coded by frequency only, which gives no larger files
/// than a search for repetitions, in a twentieth of the time. Where the result is so small that the file must repeat
/// itself, such as a flat tile's, the search is tried, too, and the smaller file returned.
Result<std::vector<std::uint8_t>> compress_gzip_of_mesh(std::span<const std::uint8_t> bytes);
/// The inverse. Fails with kInput for a file that is not gzip, is damaged, or holds more than `most` bytes.
Result<std::vector<std::uint8_t>> decompress_gzip(std::span<const std::uint8_t> bytes, std::size_t most);
/// True for bytes that begin like a gzip file.
bool is_gzip(std::span<const std::uint8_t> bytes);

}  // namespace scarp

#pragma GCC visibility pop
