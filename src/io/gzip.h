// Compression by gzip: what tiles are kept in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The bytes in a gzip file, without a time or a name: equal bytes make equal files, with one version of zlib.
Result<std::vector<std::uint8_t>> compress_gzip(std::span<const std::uint8_t> bytes);
/// The same for a mesh, whose numbers hardly repeat themselves: bytes are coded by how often they occur, which yields
/// no more bytes than a search for repetitions, in a twentieth of the time. Where so little is left that the file does
/// repeat itself, as a flat tile's does, that is tried, too, and the smaller one returned.
Result<std::vector<std::uint8_t>> compress_gzip_of_mesh(std::span<const std::uint8_t> bytes);
/// The reverse. Fails with kInput for what is no gzip file, is damaged, or holds more than `most` bytes.
Result<std::vector<std::uint8_t>> decompress_gzip(std::span<const std::uint8_t> bytes, std::size_t most);
/// True if they begin as a gzip file does.
bool is_gzip(std::span<const std::uint8_t> bytes);

}  // namespace scarp

#pragma GCC visibility pop
