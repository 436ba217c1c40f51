#include "io/gzip.h"

#include <zlib.h>

#include <algorithm>

namespace scarp::io {
namespace {

/// zlib's windowBits: the largest window, in a gzip file.
constexpr int kGzipWindow = 15 + 16;

/// zlib's memLevel for a mesh. So few symbols share a code table that positions, heights, triangles and normals have
/// separate tables.
constexpr int kMeshMemory = 5;
/// Files below this size in bytes, or compressed below this fraction, may contain repetitions.
constexpr std::size_t kSmallMesh = 6000;
constexpr double kRepeats = 0.46;

Result<std::vector<std::uint8_t>> compress(std::span<const std::uint8_t> bytes, int level, int memory, int strategy) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzipWindow, memory, strategy) != Z_OK)
    return fail(ErrorKind::kOutput, "zlib cannot begin to compress");
  std::vector<std::uint8_t> packed(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  const int end = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) return fail(ErrorKind::kOutput, "zlib cannot compress a tile");
  return packed;
}

}  // namespace

Result<std::vector<std::uint8_t>> compress_gzip(std::span<const std::uint8_t> bytes) {
  return compress(bytes, Z_BEST_COMPRESSION, 9, Z_DEFAULT_STRATEGY);
}

Result<std::vector<std::uint8_t>> compress_gzip_of_mesh(std::span<const std::uint8_t> bytes) {
  SCARP_TRY(auto&& coded, compress(bytes, Z_DEFAULT_COMPRESSION, kMeshMemory, Z_HUFFMAN_ONLY));
  const double share = static_cast<double>(coded.size()) / static_cast<double>(bytes.size());
  if (bytes.size() > kSmallMesh && share > kRepeats) return coded;
  auto matched = compress(bytes, Z_DEFAULT_COMPRESSION, kMeshMemory, Z_DEFAULT_STRATEGY);
  if (!matched || matched->size() < coded.size()) return matched;
  return coded;
}

Result<std::vector<std::uint8_t>> decompress_gzip(std::span<const std::uint8_t> bytes, std::size_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) return fail(ErrorKind::kInput, "zlib cannot begin to decompress");
  std::vector<std::uint8_t> whole(std::min(most, std::max<std::size_t>(4 * bytes.size(), 1024)));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = whole.data() + stream.total_out;
    stream.avail_out = static_cast<uInt>(whole.size() - stream.total_out);
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_OK && stream.avail_out > 0 && stream.avail_in == 0) break;
    if (state != Z_STREAM_END && stream.avail_out == 0) {
      if (whole.size() == most) break;
      whole.resize(std::min(most, 2 * whole.size()));
      state = Z_OK;
    }
  }
  whole.resize(stream.total_out);
  inflateEnd(&stream);
  if (state != Z_STREAM_END) return fail(ErrorKind::kInput, "it is no gzip file, damaged, or too large");
  return whole;
}

bool is_gzip(std::span<const std::uint8_t> bytes) { return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b; }

}  // namespace scarp::io
