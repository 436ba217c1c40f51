// Radix sort by integer keys.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/point.h"
#include "base/sort.h"

namespace scarp {

/// Stable sort by key(item), a 64-bit number. Bytes that are equal in all keys cost no time. Needs a second array of
/// the same size. Cost: O(n) per byte; some 5 ns per item for 32-bit keys.
template <class T, class Key>
void radix_sort(std::vector<T>& items, const Key& key) {
  constexpr std::size_t kFew = 128;
  if (items.size() < kFew) {
    sort_rarely(items, [&](const T& a, const T& b) { return key(a) < key(b); });
    return;
  }
  constexpr std::size_t kDigits = 8, kValues = 256;
  std::vector<std::array<std::size_t, kValues>> counts(kDigits);
  const auto digit = [&](const T& item, std::size_t place) {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(key(item)) >> (8 * place) & 0xff);
  };
  for (const T& item : items) {
    for (std::size_t place = 0; place < kDigits; ++place) ++counts[place][digit(item, place)];
  }
  std::vector<T> sorted(items.size());
  for (std::size_t place = 0; place < kDigits; ++place) {
    auto& count = counts[place];
    if (count[digit(items[0], place)] == items.size()) continue;
    std::size_t begin = 0;
    for (std::size_t& n : count) begin += std::exchange(n, begin);
    for (const T& item : items) sorted[count[digit(item, place)]++] = item;
    items.swap(sorted);
  }
}

/// Sorts points into raster order and removes duplicates. REQUIRES: coordinates of at least 0.
inline void sort_uniquely(std::vector<Point>& points) {
  radix_sort(points, [](Point p) {
    return std::uint64_t{static_cast<std::uint32_t>(p.y)} << 32 | static_cast<std::uint32_t>(p.x);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace scarp
