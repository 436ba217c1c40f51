// Morton's curve through the plane: neighbours on the curve are neighbours in the plane.
#pragma once

#include <cstdint>

namespace scarp {

/// Inserts a zero before each of the 32 bits.
inline std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// The position of (x, y) along the curve; x and y are below 2^32.
inline std::uint64_t curve_place(std::uint64_t x, std::uint64_t y) { return spread_bits(x) | spread_bits(y) << 1; }

/// The inverse of spread_bits(): every second bit, from the lowest on.
inline std::uint64_t gather_bits(std::uint64_t bits) {
  bits &= 0x5555555555555555;
  bits = (bits | bits >> 1) & 0x3333333333333333;
  bits = (bits | bits >> 2) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits >> 4) & 0x00ff00ff00ff00ff;
  bits = (bits | bits >> 8) & 0x0000ffff0000ffff;
  return (bits | bits >> 16) & 0x00000000ffffffff;
}

}  // namespace scarp
