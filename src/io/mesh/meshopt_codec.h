// The streams of EXT_meshopt_compression, by libmeshoptimizer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scarp::io {

#ifdef SCARP_WITH_MESHOPTIMIZER
inline constexpr bool kHasMeshoptCodec = true;
#else
inline constexpr bool kHasMeshoptCodec = false;
#endif

enum class MeshoptMode { kAttributes, kTriangles, kIndices };
enum class MeshoptFilter { kNone, kOctahedral, kQuaternion, kExponential };

/// A stream, and its declared contents: `count` items of `stride` bytes.
struct MeshoptStream {
  std::span<const std::uint8_t> bytes;
  MeshoptMode mode = MeshoptMode::kAttributes;
  MeshoptFilter filter = MeshoptFilter::kNone;
  std::uint64_t count = 0, stride = 0;
};

/// Reorders triangles, and vertices by first use, for the smallest encoding; unused vertices are last. The triangles
/// and their winding do not change.
void order_for_codec(std::vector<std::uint32_t>& vertices, std::vector<std::uint16_t>& corners);

/// Encodes items of `stride` bytes (a multiple of 4 up to 256) in version 0 of the codec, which every decoder reads.
/// Empty in a build without the codec.
std::vector<std::uint8_t> encode_meshopt_attributes(std::span<const std::uint8_t> items, std::size_t stride);
/// Encodes triangles by their corners. A decoded triangle may begin with another corner, in the same winding.
std::vector<std::uint8_t> encode_meshopt_triangles(std::span<const std::uint16_t> corners, std::size_t vertices);

/// Returns an error message, or null for success; `items` then holds count · stride bytes. Handles hostile streams.
/// Allocates no more than their bytes can encode.
const char* decode_meshopt(const MeshoptStream& stream, std::vector<std::uint8_t>& items);

}  // namespace scarp::io
