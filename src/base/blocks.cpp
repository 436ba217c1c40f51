#include "base/blocks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "base/parallel.h"

namespace scarp {

namespace {

/// The kept blocks, oldest first.
class Shelf {
 public:
  Block take(std::size_t bytes) {
    std::size_t best = count_;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t size = blocks_[i].bytes;
      if (size >= bytes && size / 4 <= bytes && (best == count_ || size < blocks_[best].bytes)) best = i;
    }
    return best == count_ ? Block{} : remove(best);
  }
  void put(Block block) {
    while (count_ == blocks_.size() || bytes_ + block.bytes > kMostKept) std::free(remove(0).data);
    blocks_[count_++] = block;
    bytes_ += block.bytes;
  }

 private:
  Block remove(std::size_t i) {
    const Block removed = blocks_[i];
    std::copy(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              blocks_.begin() + static_cast<std::ptrdiff_t>(count_), blocks_.begin() + static_cast<std::ptrdiff_t>(i));
    --count_;
    bytes_ -= removed.bytes;
    return removed;
  }

  std::array<Block, 128> blocks_;
  std::size_t count_ = 0, bytes_ = 0;
};

/// Never destroyed, since static arrays may be destroyed later. Allocated in static memory, so it cannot fail.
Shared<Shelf>& shared_shelf() {
  alignas(Shared<Shelf>) static std::byte place[sizeof(Shared<Shelf>)];
  static auto& shelf = *new (place) Shared<Shelf>;
  return shelf;
}

}  // namespace

Block take_block(std::size_t bytes) noexcept {
  if (bytes < kLeastKept || bytes > kLargestKept) return {};
  return shared_shelf().with([&](Shelf& shelf) { return shelf.take(bytes); });
}

void leave_block(Block block) noexcept {
  if (block.bytes < kLeastKept || block.bytes > kLargestKept) {
    std::free(block.data);
    return;
  }
  shared_shelf().with([&](Shelf& shelf) { shelf.put(block); });
}

}  // namespace scarp
