// Vectors of many megabytes.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp {

/// Maps the memory immediately, with several threads, if the system supports it. Otherwise pages are mapped when they
/// are first written.
void map_pages(void* data, std::size_t bytes, int threads);

/// New elements are 0. Most of the time is spent on mapping pages. REQUIRES: `values` is empty.
template <class T>
void resize_large(std::vector<T>& values, std::size_t size, int threads) {
  values.reserve(size);
  map_pages(values.data(), size * sizeof(T), threads);
  values.resize(size);
}

}  // namespace scarp
