// A cache of freed memory blocks.
//
// A system maps a large block page by page, with a fault and zeroing for each page, and unmaps the block when it is
// freed. A program that simplifies many small rasters would spend much of its time on mapping blocks of the same sizes.
// So freed blocks of medium size are kept for the next array, at most kMostKept bytes in all. The oldest blocks are
// freed first.
#pragma once

#include <cstddef>

namespace scarp {

struct Block {
  void* data = nullptr;  ///< allocated by malloc()
  std::size_t bytes = 0;
};

inline constexpr std::size_t kLeastKept = std::size_t{16} << 10;    ///< malloc() handles smaller blocks
inline constexpr std::size_t kLargestKept = std::size_t{16} << 20;  ///< larger blocks are not worth keeping
inline constexpr std::size_t kMostKept = std::size_t{32} << 20;

/// Removes and returns the smallest kept block of `bytes` to 4·`bytes` bytes; null if there is none. The caller owns
/// the block. This function and leave_block() are thread-safe.
Block take_block(std::size_t bytes) noexcept;
/// Keeps the block, or frees it.
void leave_block(Block block) noexcept;

}  // namespace scarp
