// Sorting with little code.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>

#include "base/function_ref.h"

namespace scarp {
namespace detail {

/// Like sort_rarely(), for `count` items of `size` bytes each.
void sort_bytes(std::byte* items, std::size_t count, std::size_t size,
                FunctionRef<bool(const std::byte* a, const std::byte* b)> before);

}  // namespace detail

/// Stable sort by before(a, b). All types share one loop, so a call costs few bytes of code but more time than
/// std::sort(). For sorts that are short compared with the work around them. Needs a second array of the same size, and
/// 8 bytes per item. REQUIRES: fewer than 2^32 items.
template <class Items, class Before = std::less<>>
void sort_rarely(Items& items, const Before& before = {}) {
  using Item = std::remove_reference_t<decltype(items[0])>;
  static_assert(std::is_trivially_copy_constructible_v<Item> && std::is_trivially_destructible_v<Item>);
  detail::sort_bytes(reinterpret_cast<std::byte*>(std::data(items)), std::size(items), sizeof(Item),
                     [&before](const std::byte* a, const std::byte* b) {
                       return before(*reinterpret_cast<const Item*>(a), *reinterpret_cast<const Item*>(b));
                     });
}

}  // namespace scarp
