// Blocks kept for the next array.
#include "base/blocks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/array.h"

namespace scarp {
namespace {

/// Empties the shelf except for a small block; the oldest blocks leave first.
void empty_shelf() {
  for (std::size_t bytes = 0; bytes < kMostKept; bytes += kLargestKept)
    leave_block({std::malloc(kLargestKept), kLargestKept});
  while (true) {
    const Block block = take_block(kLargestKept);
    if (block.data == nullptr) break;
    std::free(block.data);
  }
}

TEST(blocks, that_were_left_are_taken_again) {
  empty_shelf();
  EXPECT_EQ(take_block(kLeastKept).data, nullptr);
  void* data = std::malloc(100'000);
  leave_block({data, 100'000});
  EXPECT_EQ(take_block(100'001).data, nullptr) << "too small";
  EXPECT_EQ(take_block(24'999).data, nullptr) << "far too large";
  const Block taken = take_block(30'000);
  EXPECT_EQ(taken.data, data);
  EXPECT_EQ(taken.bytes, 100'000u);
  EXPECT_EQ(take_block(30'000).data, nullptr) << "taken twice";
  std::free(taken.data);
}

TEST(blocks, the_smallest_that_fits_is_taken) {
  empty_shelf();
  for (const std::size_t bytes : {90'000u, 50'000u, 70'000u}) leave_block({std::malloc(bytes), bytes});
  for (const std::size_t bytes : {70'000u, 90'000u, 0u}) {
    const Block taken = take_block(60'000);
    EXPECT_EQ(taken.bytes, bytes);
    std::free(taken.data);
  }
  empty_shelf();
}

TEST(blocks, no_more_than_the_limit_are_kept_and_the_oldest_go_first) {
  empty_shelf();
  constexpr std::size_t kBytes = std::size_t{1} << 20;
  for (std::size_t i = 0; i < 2 * kMostKept / kBytes; ++i) leave_block({std::malloc(kBytes + i), kBytes + i});
  std::size_t kept = 0;
  for (Block block = take_block(kBytes); block.data != nullptr; block = take_block(kBytes)) {
    kept += block.bytes;
    EXPECT_GE(block.bytes, kBytes + kMostKept / kBytes) << "an old one";
    std::free(block.data);
  }
  EXPECT_LE(kept, kMostKept);
  EXPECT_GT(kept, kMostKept - 2 * kBytes);
}

TEST(blocks, arrays_grow_into_them_and_keep_their_elements) {
  empty_shelf();
  for (int round = 0; round < 3; ++round) {
    Array<std::uint32_t> values, others;
    for (std::uint32_t i = 0; i < 300'000; ++i) {
      values.push_back(i);
      others.push_back(~i);
    }
    bool are_kept = true;
    for (std::uint32_t i = 0; i < 300'000; ++i) are_kept = are_kept && values[i] == i && others[i] == ~i;
    EXPECT_TRUE(are_kept);
    values.release();
    EXPECT_TRUE(values.empty());
    values.push_back(7);
    EXPECT_EQ(values[0], 7u);
  }
}

}  // namespace
}  // namespace scarp
