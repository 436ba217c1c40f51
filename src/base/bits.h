// Parts of <bit> and <memory> that some standard libraries lack (libc++ 13 in Emscripten 3.1).
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace scarp {

/// std::bit_cast.
template <class To, class From>
[[gnu::always_inline]] constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

/// An array whose elements are not initialised.
template <class T>
std::unique_ptr<T[]> make_unfilled(std::size_t count) {
  static_assert(std::is_trivially_default_constructible_v<T>);
  return std::unique_ptr<T[]>(new T[count]);
}

}  // namespace scarp
