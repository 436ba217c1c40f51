// The program's memory: large blocks on huge pages, where the system grants them on request. With pages of
// 4 kB, page faults cost a quarter to a half of a run's time (bench/performance.md).
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef MADV_HUGEPAGE

namespace {

constexpr std::size_t kLeast = std::size_t{4} << 20;  // smaller blocks come from the heap, which keeps its pages
constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;

/// A refusal costs speed alone.
void request_huge_pages(void* block, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + kPage - 1) / kPage * kPage, last = (begin + size) / kPage * kPage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* const block = std::malloc(size > 0 ? size : 1)) {
      if (size >= kLeast) request_huge_pages(block, size);
      return block;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
