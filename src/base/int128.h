// 128-bit integers.
#pragma once

namespace scarp {

__extension__ using Int128 = __int128;

template <class T>
constexpr int sign_of(T value) {
  return (value > T(0)) - (value < T(0));
}

}  // namespace scarp
