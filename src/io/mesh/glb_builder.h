// Assembles a GLB file: accessors, views, and the pieces of its binary chunk, written when all sizes are known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/mesh/glb_json.h"
#include "scarp/result.h"

namespace scarp::io {

constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;
constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

class GlbBuilder {
 public:
  using Write = std::function<void(std::uint8_t* at)>;

  /// Everything except accessors, views and buffers.
  Json json = Json::object();

  std::size_t accessor_count() const { return accessors_.size(); }
  Json& add_accessor(std::size_t view, int component, std::uint64_t count, const char* type);
  /// Adds a view of `size` uncompressed bytes in the binary chunk. Returns the view's number. A target or stride of 0
  /// is not written.
  std::size_t add_view(std::uint64_t size, int target, std::size_t stride, Write write);
  /// Adds a view of compressed items. Readers decompress them into the second buffer, which is not in the file.
  std::size_t add_packed(std::vector<std::uint8_t> stream, int target, std::uint64_t count, std::size_t stride,
                         const char* mode, const char* filter = nullptr);
  /// Builds the file. Fails with kOutput from 4 GiB on. REQUIRES: everything that the pieces' Write functions read
  /// still exists.
  Result<std::vector<std::uint8_t>> assemble(int threads);

 private:
  struct Piece {
    std::uint64_t offset;
    Write write;
  };
  /// Returns the piece's offset in the binary chunk, a multiple of 4.
  std::uint64_t add_piece(std::uint64_t size, Write write);

  std::vector<Piece> pieces_;
  std::uint64_t size_ = 0;      // size of the binary chunk
  std::uint64_t unpacked_ = 0;  // bytes of the second buffer
  Json accessors_ = Json::array(), views_ = Json::array();
};

}  // namespace scarp::io
