// Numbers in byte arrays, independent of the machine's byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace scarp::io {

/// The number of type T at `at`, which need not be aligned.
template <class T>
T load_number(const std::uint8_t* at, std::endian order = std::endian::little) {
  std::uint8_t bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = at[order == std::endian::native ? i : sizeof(T) - 1 - i];
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Writes `value` in little-endian order and advances `at`.
template <class T>
void store_number(std::uint8_t*& at, T value) {
  std::uint8_t bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    at[i] = bytes[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i];
  }
  at += sizeof(T);
}

}  // namespace scarp::io
