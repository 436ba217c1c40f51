// Sorting many items by a whole number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace scarp {

/// Stable sort by key(item), a whole number of up to 64 bits, in passes over 11 bits each; passes in which all keys
/// agree are omitted. Needs a second array of the same size.
template <class Item, class Key>
void sort_by_key(std::vector<Item>& items, const Key& key) {
  constexpr int kBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  std::uint64_t varying = 0;
  for (const Item& item : items) varying |= key(item) ^ key(items.front());
  std::vector<Item> sorted(varying == 0 ? 0 : items.size());
  for (int shift = 0; shift < 64 && varying >> shift != 0; shift += kBits) {
    const auto digit = [&](const Item& item) { return key(item) >> shift & (kDigits - 1); };
    if ((varying >> shift & (kDigits - 1)) == 0) continue;
    std::array<std::size_t, kDigits> next{};
    for (const Item& item : items) ++next[digit(item)];
    std::size_t sum = 0;
    for (std::size_t& at : next) sum += std::exchange(at, sum);
    for (const Item& item : items) sorted[next[digit(item)]++] = item;
    items.swap(sorted);
  }
}

}  // namespace scarp
