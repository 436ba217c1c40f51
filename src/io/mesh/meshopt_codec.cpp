#include "io/mesh/meshopt_codec.h"

#ifdef SCARP_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <limits>
#include <utility>

namespace scarp::io {

#ifdef SCARP_WITH_MESHOPTIMIZER

namespace {

/// A stream's first byte identifies codec and version.
constexpr std::uint8_t kLaterAttributes = 0xA1;

const char* find_impossible(const MeshoptStream& stream) {
  const bool is_attributes = stream.mode == MeshoptMode::kAttributes;
  const std::uint64_t stride = stream.stride;
  if (is_attributes ? stride == 0 || stride % 4 != 0 || stride > 256 : stride != 2 && stride != 4)
    return "has a stride that its mode does not allow";
  if (stream.mode == MeshoptMode::kTriangles && stream.count % 3 != 0)
    return "holds triangles, and its count is no multiple of 3";
  const bool filter_fits = stream.filter == MeshoptFilter::kNone ||
                           (is_attributes && (stream.filter == MeshoptFilter::kOctahedral   ? stride == 4 || stride == 8
                                              : stream.filter == MeshoptFilter::kQuaternion ? stride == 8
                                                                                            : true));
  if (!filter_fits) return "has a filter that its mode or stride does not allow";
  // Sixteen bytes of attributes need at least two bits; an index or a triangle needs at least a byte.
  constexpr std::uint64_t kPerByte = 64, kSlack = 1 << 16;
  const std::uint64_t most = kPerByte * stream.bytes.size() + kSlack;
  if (stream.bytes.empty() || stream.count > most || stream.count * stride > most)
    return "is too short for what it says that it holds";
  return nullptr;
}

void undo_filter(const MeshoptStream& stream, std::uint8_t* items) {
  if (stream.filter == MeshoptFilter::kOctahedral) meshopt_decodeFilterOct(items, stream.count, stream.stride);
  if (stream.filter == MeshoptFilter::kQuaternion) meshopt_decodeFilterQuat(items, stream.count, stream.stride);
  if (stream.filter == MeshoptFilter::kExponential) meshopt_decodeFilterExp(items, stream.count, stream.stride);
}

}  // namespace

void order_for_codec(std::vector<std::uint32_t>& vertices, std::vector<std::uint16_t>& corners) {
  const std::vector<std::uint32_t> given(corners.begin(), corners.end());
  std::vector<std::uint32_t> ordered(given.size()), places(vertices.size()), moved(vertices.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), given.data(), given.size(), vertices.size());
  std::size_t used = meshopt_optimizeVertexFetchRemap(places.data(), ordered.data(), ordered.size(), vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (places[v] == std::numeric_limits<std::uint32_t>::max()) places[v] = static_cast<std::uint32_t>(used++);
    moved[places[v]] = vertices[v];
  }
  vertices = std::move(moved);
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint16_t>(places[ordered[i]]);
}

std::vector<std::uint8_t> encode_meshopt_attributes(std::span<const std::uint8_t> items, std::size_t stride) {
  const std::size_t count = items.size() / stride;
  meshopt_encodeVertexVersion(0);
  std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), items.data(), count, stride));
  return bytes;
}

std::vector<std::uint8_t> encode_meshopt_triangles(std::span<const std::uint16_t> corners, std::size_t vertices) {
  meshopt_encodeIndexVersion(1);
  std::vector<std::uint8_t> bytes(meshopt_encodeIndexBufferBound(corners.size(), vertices));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), corners.size()));
  return bytes;
}

const char* decode_meshopt(const MeshoptStream& stream, std::vector<std::uint8_t>& items) {
  if (const char* why = find_impossible(stream)) return why;
  if (stream.mode == MeshoptMode::kAttributes && stream.bytes[0] == kLaterAttributes)
    return "is of a later version of the codec; compress it with version 0";
  items.resize(stream.count * stream.stride);
  void* const to = items.data();
  const std::size_t count = stream.count, stride = stream.stride, size = stream.bytes.size();
  const std::uint8_t* const from = stream.bytes.data();
  const int failed = stream.mode == MeshoptMode::kAttributes ? meshopt_decodeVertexBuffer(to, count, stride, from, size)
                     : stream.mode == MeshoptMode::kTriangles
                         ? meshopt_decodeIndexBuffer(to, count, stride, from, size)
                         : meshopt_decodeIndexSequence(to, count, stride, from, size);
  if (failed != 0) return "is broken or cut off";
  undo_filter(stream, items.data());
  return nullptr;
}

#else

void order_for_codec(std::vector<std::uint32_t>&, std::vector<std::uint16_t>&) {}
std::vector<std::uint8_t> encode_meshopt_attributes(std::span<const std::uint8_t>, std::size_t) { return {}; }
std::vector<std::uint8_t> encode_meshopt_triangles(std::span<const std::uint16_t>, std::size_t) { return {}; }
const char* decode_meshopt(const MeshoptStream&, std::vector<std::uint8_t>&) {
  return "is compressed, which this build cannot read: it has no libmeshoptimizer";
}

#endif

}  // namespace scarp::io
