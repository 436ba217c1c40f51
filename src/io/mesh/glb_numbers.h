// Numbers of the GLB container and of glTF's component types.
#pragma once

#include <cstdint>

namespace scarp::io {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kInt8Component = 5120, kUint8Component = 5121, kInt16Component = 5122, kUint16Component = 5123,
              kUint32Component = 5125, kFloatComponent = 5126;

}  // namespace scarp::io
