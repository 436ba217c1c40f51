// Common parts of all functions of the WebAssembly interface: numbers and messages. No exception leaves these
// functions.
//
// JavaScript can access memory and doubles. Arguments and results are structs of doubles, which are Float64Arrays in
// JavaScript; a pointer is passed as its address. The functions are those of bindings/c/scarp_c.h for the core, without
// options by name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"

#define SCARP_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace scarp::wasm {

/// Stores the error for scarp_error_kind() and scarp_error_text().
void keep(const Error& error);
/// Stores the current exception.
void keep_exception();

/// Runs `work`, which returns a Result; returns `none` if it fails.
template <class T, class Work>
T guarded(T none, Work&& work) noexcept {
  try {
    auto made = work();
    if (made) return std::move(*made);
    keep(made.error());
  } catch (...) {
    keep_exception();
  }
  return none;
}

/// Runs `work` and returns a handle, which JavaScript frees.
template <class T, class Work>
T* give(Work&& work) noexcept {
  return guarded<std::unique_ptr<T>>(nullptr, work).release();
}

template <class T>
T* at(double address) {
  return reinterpret_cast<T*>(static_cast<std::uintptr_t>(address));
}
template <class T>
double address_of(const T* place) {
  return static_cast<double>(reinterpret_cast<std::uintptr_t>(place));
}
inline std::optional<double> given(double number) {
  return number == number ? std::optional<double>(number) : std::nullopt;
}
inline std::optional<std::uint64_t> budget(double number) {
  return number > 0 ? std::optional<std::uint64_t>(static_cast<std::uint64_t>(number)) : std::nullopt;
}

/// `geotransform`: like GDAL's, of pixel corners.
struct Field {
  double samples, cols, rows, nodata, sample_rounding;
  double place;  ///< 0: on the grid; 1: by the geotransform; 2: by a geotransform in degrees, with the mesh in metres
  double geotransform[6];
};
/// Maps samples, whose centres have integer coordinates, to x and y.
std::array<double, 6> affine_of(const Field& given);
Result<HeightField> take_field(const Field& given);

/// A callback to JavaScript, which may cancel.
ProgressCallback ask_javascript();

}  // namespace scarp::wasm
