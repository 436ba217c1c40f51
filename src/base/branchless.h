// The smaller and the larger of two numbers, and the whole part of a number, without unpredictable branches.
//
// lesser() and greater() equal std::min and std::max: for equal numbers, or with a NaN, they return the first. Most
// machines have instructions for these functions. WebAssembly has such instructions only for vectors, and its engines
// compile the scalar ones to branches.
#pragma once

#include <cstdint>

#include "base/bits.h"

#ifdef __wasm_simd128__
#include <wasm_simd128.h>
#else
#include <algorithm>
#endif

namespace scarp {

// whole_part(v): v without its fraction. REQUIRES: 0 <= v < 2³¹.
#ifdef __wasm_simd128__
[[gnu::always_inline]] inline std::int32_t whole_part(double v) {
  const double sum = v + 0x1p52, nearest = sum - 0x1p52;
  return static_cast<std::int32_t>(bit_cast<std::int64_t>(sum)) - (nearest > v ? 1 : 0);
}
[[gnu::always_inline]] inline double lesser(double a, double b) {
  return wasm_f64x2_extract_lane(wasm_f64x2_pmin(wasm_f64x2_splat(a), wasm_f64x2_splat(b)), 0);
}
[[gnu::always_inline]] inline double greater(double a, double b) {
  return wasm_f64x2_extract_lane(wasm_f64x2_pmax(wasm_f64x2_splat(a), wasm_f64x2_splat(b)), 0);
}
#else
[[gnu::always_inline]] inline std::int32_t whole_part(double v) { return static_cast<std::int32_t>(v); }
[[gnu::always_inline]] inline double lesser(double a, double b) { return std::min(a, b); }
[[gnu::always_inline]] inline double greater(double a, double b) { return std::max(a, b); }
#endif

[[gnu::always_inline]] inline double lesser(double a, double b, double c) { return lesser(lesser(a, b), c); }
[[gnu::always_inline]] inline double greater(double a, double b, double c) { return greater(greater(a, b), c); }

}  // namespace scarp
