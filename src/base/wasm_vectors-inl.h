// Functions that Highway 1.0 lacks under WebAssembly: vectors of doubles, and operations for which the machine has one
// instruction but compilers emit many.
//
// SCARP_HAVE_FLOAT64 is nonzero where vectors of doubles exist. Functions in hwy have the meaning of Highway's
// functions of the same names. Functions in scarp give the same bits on all instruction sets.

// An include guard like Highway's: one inclusion per instruction set.
#if defined(SCARP_WASM_VECTORS) == defined(HWY_TARGET_TOGGLE)
#ifdef SCARP_WASM_VECTORS
#undef SCARP_WASM_VECTORS
#else
#define SCARP_WASM_VECTORS
#endif

#include <hwy/highway.h>

#undef SCARP_HAVE_FLOAT64
#if HWY_TARGET == HWY_WASM
#define SCARP_HAVE_FLOAT64 1
#else
#define SCARP_HAVE_FLOAT64 HWY_HAVE_FLOAT64
#endif

HWY_BEFORE_NAMESPACE();

#if HWY_TARGET == HWY_WASM && !HWY_HAVE_FLOAT64

namespace hwy::HWY_NAMESPACE {

using Doubles = Simd<double, 2, 0>;
using DoubleVec = Vec128<double, 2>;
using DoubleMask = Mask128<double, 2>;

HWY_API DoubleVec Set(Doubles, double value) { return {wasm_f64x2_splat(value)}; }
HWY_API DoubleVec Iota(Doubles, double first) { return {wasm_f64x2_make(first, first + 1)}; }
HWY_API double GetLane(DoubleVec v) { return wasm_f64x2_extract_lane(v.raw, 0); }
HWY_API DoubleVec Add(DoubleVec a, DoubleVec b) { return {wasm_f64x2_add(a.raw, b.raw)}; }
HWY_API DoubleVec Sub(DoubleVec a, DoubleVec b) { return {wasm_f64x2_sub(a.raw, b.raw)}; }
HWY_API DoubleVec Mul(DoubleVec a, DoubleVec b) { return {wasm_f64x2_mul(a.raw, b.raw)}; }
HWY_API DoubleVec Abs(DoubleVec v) { return {wasm_f64x2_abs(v.raw)}; }
HWY_API DoubleVec Ceil(DoubleVec v) { return {wasm_f64x2_ceil(v.raw)}; }
HWY_API DoubleVec Floor(DoubleVec v) { return {wasm_f64x2_floor(v.raw)}; }
HWY_API DoubleVec Max(DoubleVec a, DoubleVec b) { return {wasm_f64x2_pmax(a.raw, b.raw)}; }
HWY_API DoubleVec Min(DoubleVec a, DoubleVec b) { return {wasm_f64x2_pmin(a.raw, b.raw)}; }
HWY_API DoubleMask Eq(DoubleVec a, DoubleVec b) { return {wasm_f64x2_eq(a.raw, b.raw)}; }
HWY_API DoubleMask Ne(DoubleVec a, DoubleVec b) { return {wasm_f64x2_ne(a.raw, b.raw)}; }
HWY_API DoubleMask Lt(DoubleVec a, DoubleVec b) { return {wasm_f64x2_lt(a.raw, b.raw)}; }
HWY_API DoubleMask Le(DoubleVec a, DoubleVec b) { return {wasm_f64x2_le(a.raw, b.raw)}; }
HWY_API DoubleMask Gt(DoubleVec a, DoubleVec b) { return {wasm_f64x2_gt(a.raw, b.raw)}; }
HWY_API DoubleMask Ge(DoubleVec a, DoubleVec b) { return {wasm_f64x2_ge(a.raw, b.raw)}; }
HWY_API DoubleVec PromoteTo(Doubles, Vec128<float, 2> v) { return {wasm_f64x2_promote_low_f32x4(v.raw)}; }
HWY_API Vec128<float, 2> DemoteTo(Simd<float, 2, 0>, DoubleVec v) { return {wasm_f32x4_demote_f64x2_zero(v.raw)}; }

}  // namespace hwy::HWY_NAMESPACE

#endif

namespace scarp::HWY_NAMESPACE {

/// For float32. REQUIRES: no value is NaN.
template <class V>
HWY_INLINE V larger_of(V a, V b) {
  static_assert(sizeof(hwy::HWY_NAMESPACE::TFromV<V>) == 4);
#if HWY_TARGET == HWY_WASM
  return V{wasm_f32x4_pmax(a.raw, b.raw)};
#else
  return hwy::HWY_NAMESPACE::Max(a, b);
#endif
}
template <class V>
HWY_INLINE V smaller_of(V a, V b) {
  static_assert(sizeof(hwy::HWY_NAMESPACE::TFromV<V>) == 4);
#if HWY_TARGET == HWY_WASM
  return V{wasm_f32x4_pmin(a.raw, b.raw)};
#else
  return hwy::HWY_NAMESPACE::Min(a, b);
#endif
}

/// Truncated doubles, for lanes below 2³¹ in magnitude that are at least 0 or integers. Other lanes are unspecified.
template <class DI, class V>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<DI> whole_parts([[maybe_unused]] DI di, V v) {
#if HWY_TARGET == HWY_WASM
  // The low bits of the sum are the nearest integer; where this integer exceeds v, subtract one.
  const auto whole = wasm_f64x2_splat(0x1.8p52);
  const auto sum = wasm_f64x2_add(v.raw, whole);
  const auto is_above = wasm_f64x2_gt(wasm_f64x2_sub(sum, whole), v.raw);
  const auto below = wasm_i64x2_add(sum, is_above);
  return {wasm_i32x4_shuffle(below, below, 0, 2, 0, 2)};
#else
  return hwy::HWY_NAMESPACE::DemoteTo(di, v);
#endif
}

/// True if the mask is false in all lanes.
template <class D, class M>
HWY_INLINE bool none_of([[maybe_unused]] D d, M mask) {
#if HWY_TARGET == HWY_WASM
  return !wasm_v128_any_true(mask.raw);
#else
  return hwy::HWY_NAMESPACE::AllFalse(d, mask);
#endif
}

/// Float32 |values| where `meant` is true and the value is not NaN; else 0.
template <class V, class M>
HWY_INLINE V magnitudes(V values, M meant) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_WASM
  const auto kept = wasm_v128_and(wasm_v128_and(meant.raw, wasm_i32x4_const_splat(0x7fffffff)), values.raw);
  return V{wasm_f32x4_pmax(wasm_i32x4_const_splat(0), kept)};
#else
  return hn::IfThenElseZero(hn::And(meant, hn::Eq(values, values)), hn::Abs(values));
#endif
}

/// For float32: where `value` is larger than `most`, sets `most` to it and `at` to its place. REQUIRES: no lane of
/// `most` is NaN.
template <class V>
HWY_INLINE void take_larger(V value, V place, V& most, V& at) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto is_more = hn::Gt(value, most);
#if HWY_TARGET == HWY_WASM
  most = V{wasm_f32x4_pmax(most.raw, value.raw)};
#else
  most = hn::IfThenElse(is_more, value, most);
#endif
  at = hn::IfThenElse(is_more, place, at);
}

}  // namespace scarp::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif
