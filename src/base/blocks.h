// Blocks of memory that wait to be used again.
//
// A system gives large blocks page by page, each with a fault and a page of zeros, and reclaims them when they are
// freed. A program that simplifies many small rasters would spend a good part of its time on that, always for blocks of
// the same sizes. So blocks of a middle size are kept for the next array that wants one: at most kMostKept bytes, the
// oldest go first, until the process ends.
#pragma once

#include <cstddef>

namespace scarp {

struct Block {
  void* data = nullptr;  ///< block of malloc()
  std::size_t bytes = 0;
};

inline constexpr std::size_t kLeastKept = std::size_t{16} << 10;    ///< a smaller block is malloc()'s own business
inline constexpr std::size_t kLargestKept = std::size_t{16} << 20;  ///< a larger one is worth its faults
inline constexpr std::size_t kMostKept = std::size_t{32} << 20;

/// A kept block of `bytes` to four times as many, the smallest of them; null if there is none. It belongs to the
/// caller. Several threads may call these at once.
Block take_block(std::size_t bytes) noexcept;
/// Keeps the block, or frees it.
void leave_block(Block block) noexcept;

}  // namespace scarp
