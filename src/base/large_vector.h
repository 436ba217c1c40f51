// Vectors of many megabytes.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp {

/// Has the system map the memory now, by several threads at once, where it can; else it comes page by page, when it is
/// written.
void map_pages(void* data, std::size_t bytes, int threads);

/// REQUIRES: empty. New elements are 0. A system spends most of the time of this on finding pages of memory.
template <class T>
void resize_large(std::vector<T>& values, std::size_t size, int threads) {
  values.reserve(size);
  map_pages(values.data(), size * sizeof(T), threads);
  values.resize(size);
}

}  // namespace scarp
