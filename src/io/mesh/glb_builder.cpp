#include "io/mesh/glb_builder.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_numbers.h"

namespace scarp::io {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;

std::uint64_t pad4(std::uint64_t size) { return (size + 3) / 4 * 4; }

}  // namespace

std::uint64_t GlbBuilder::add_piece(std::uint64_t size, Write write) {
  const std::uint64_t offset = pad4(size_);
  pieces_.push_back({offset, std::move(write)});
  size_ = offset + size;
  return offset;
}

Json& GlbBuilder::add_accessor(std::size_t view, int component, std::uint64_t count, const char* type) {
  accessors_.push_back({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return accessors_.back();
}

std::size_t GlbBuilder::add_view(std::uint64_t size, int target, std::size_t stride, Write write) {
  Json view = {{"buffer", 0}, {"byteOffset", add_piece(size, std::move(write))}, {"byteLength", size}};
  if (stride > 0) view["byteStride"] = stride;
  if (target > 0) view["target"] = target;
  views_.push_back(std::move(view));
  return views_.size() - 1;
}

std::size_t GlbBuilder::add_packed(std::vector<std::uint8_t> stream, int target, std::uint64_t count,
                                   std::size_t stride, const char* mode, const char* filter) {
  const std::uint64_t size = count * stride, packed_size = stream.size();
  Json packed = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", packed_size}};
  packed["byteOffset"] = add_piece(
      packed_size, [stream = std::move(stream)](std::uint8_t* at) { std::memcpy(at, stream.data(), stream.size()); });
  packed["byteStride"] = stride;
  packed["count"] = count;
  packed["mode"] = mode;
  if (filter != nullptr) packed["filter"] = filter;
  Json view = {{"buffer", 1}, {"byteOffset", unpacked_}, {"byteLength", size}};
  if (target == kArrayBuffer) view["byteStride"] = stride;
  view["target"] = target;
  view["extensions"] = {{kMeshoptExtension, std::move(packed)}};
  views_.push_back(std::move(view));
  unpacked_ = pad4(unpacked_ + size);
  return views_.size() - 1;
}

Result<std::vector<std::uint8_t>> GlbBuilder::assemble(int threads) {
  json["accessors"] = std::move(accessors_);
  json["bufferViews"] = std::move(views_);
  json["buffers"] = Json::array({{{"byteLength", size_}}});
  if (unpacked_ > 0)
    json["buffers"].push_back({{"byteLength", unpacked_}, {"extensions", {{kMeshoptExtension, {{"fallback", true}}}}}});
  std::string text = print_json(json);
  text.resize(pad4(text.size()), ' ');
  const std::uint64_t binary = pad4(size_);
  const std::uint64_t total = 28 + text.size() + binary;
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kOutput,
                fmt::format("a GLB file holds less than 4 GiB, and this mesh needs {:.1f} GiB; write PLY instead",
                            static_cast<double>(total) / (1 << 30)));
  }
  std::vector<std::uint8_t> bytes;
  resize_large(bytes, total, threads);
  std::uint8_t* at = bytes.data();
  for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(total),
                                   static_cast<std::uint32_t>(text.size()), kJsonChunk}) {
    store_number(at, word);
  }
  std::memcpy(at, text.data(), text.size());
  at += text.size();
  store_number(at, static_cast<std::uint32_t>(binary));
  store_number(at, kBinaryChunk);
  parallel_for(pieces_.size(), threads, [&](std::size_t i) { pieces_[i].write(at + pieces_[i].offset); });
  return bytes;
}

}  // namespace scarp::io
