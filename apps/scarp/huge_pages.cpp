// The program's memory: blocks on huge pages, if the system grants them, and a heap that reuses freed memory for the
// next block. With pages of 4 kB, which the system zeroes anew for each block, page faults cost a quarter to a half of
// a run's time (bench/performance.md).
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "base/after_allocation.h"

#if defined(MADV_HUGEPAGE) && defined(__GLIBC__)
#include <malloc.h>

namespace {

constexpr std::size_t kLeast = std::size_t{128} << 10;
constexpr std::size_t kLargestInHeap = std::size_t{32} << 20;  // the C library's limit
constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;

/// A refusal only costs speed. A small block shares its first and last page with other blocks.
void request_huge_pages(void* block, std::size_t size) {
  if (size < kLeast) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(block), end = begin + size;
  const std::uintptr_t slack = size < 2 * kPage ? 0 : kPage - 1;
  const std::uintptr_t first = (begin + slack) / kPage * kPage, last = (end + kPage - 1 - slack) / kPage * kPage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

[[maybe_unused]] const bool is_set = [] {
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(kLargestInHeap));
  mallopt(M_TRIM_THRESHOLD, static_cast<int>(2 * kLargestInHeap));
  mallopt(M_TOP_PAD, static_cast<int>(2 * kPage));
  scarp::after_allocation = request_huge_pages;
  return true;
}();

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  for (;;) {
    if (void* const block = std::malloc(size > 0 ? size : 1)) {
      request_huge_pages(block, size);
      return block;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

/// These forms are also replaced, so that a runtime that replaces all forms, such as a sanitizer's, sees one allocator.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
