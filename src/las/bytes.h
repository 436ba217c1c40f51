// Little-endian numbers in bytes, and access to the bytes of a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/bits.h"
#include "base/function_ref.h"
#include "scarp/result.h"

namespace scarp::las {

template <class T>
T load(const std::uint8_t* at) {
  std::array<std::uint8_t, sizeof(T)> bytes;
  for (std::size_t k = 0; k < sizeof(T); ++k) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    bytes[k] = at[k];
#else
    bytes[k] = at[sizeof(T) - 1 - k];
#endif
  }
  return scarp::bit_cast<T>(bytes);
}

/// A file, or bytes in memory. Several threads may read at once.
struct Source {
  std::string name;  ///< for messages
  std::uint64_t size = 0;
  /// Returns false if the bytes cannot be read. REQUIRES: they lie within `size`.
  FunctionRef<bool(std::uint64_t offset, std::span<std::uint8_t> into)> read;

  /// True if the source has `bytes` bytes from `offset` on.
  bool holds(std::uint64_t offset, std::uint64_t bytes) const { return offset <= size && bytes <= size - offset; }
};

/// The error of a file that cannot be read.
inline tl::unexpected<Error> refuse(const std::string& name, const std::string& why) {
  return fail(ErrorKind::kInput, name + ": " + why);
}

}  // namespace scarp::las
