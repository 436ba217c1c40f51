#include "base/large_vector.h"

#include <cstdint>

#include "base/parallel.h"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace scarp {

void map_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] int threads) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t kLargestPage = 1 << 16;  // the largest page size of any machine
  constexpr std::size_t kTogether = std::size_t{4} << 20;
  if (bytes < kTogether) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t start = (begin + kLargestPage - 1) & ~(kLargestPage - 1);
  const std::uintptr_t stop = (begin + bytes) & ~(kLargestPage - 1);
  // If this fails, pages are mapped when written.
  parallel_for_parts(stop - start, kTogether, threads, [&](std::size_t first, std::size_t end) {
    (void)madvise(reinterpret_cast<void*>(start + first), end - first, MADV_POPULATE_WRITE);
  });
#endif
}

}  // namespace scarp
