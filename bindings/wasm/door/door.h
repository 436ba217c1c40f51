// Common parts of all functions of the WebAssembly door: numbers, sentences, and no exception that goes out.
//
// JavaScript sees memory and doubles. Arguments and results are structs of doubles alone, which it writes and reads as
// one Float64Array each; a pointer among them is its address. The functions are those of bindings/c/scarp_c.h on the
// core alone, without the program's options by name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"

#define SCARP_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace scarp::wasm {

/// For scarp_error_kind() and scarp_error_text().
void keep(const Error& error);
/// The one that is being handled.
void keep_exception();

/// Runs `work`, which returns a Result; `none` where it fails.
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

/// The same of a handle, which JavaScript frees.
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

/// `geotransform`: GDAL's, of pixel corners.
struct Field {
  double samples, cols, rows, nodata, sample_rounding;
  double place;  ///< 0: on the grid; 1: by the geotransform; 2: it is in degrees, and the mesh in metres
  double geotransform[6];
};
/// From samples, whose centres have whole numbers, to x and y.
std::array<double, 6> affine_of(const Field& given);
Result<HeightField> take_field(const Field& given);

/// Asks JavaScript, which may cancel.
ProgressCallback ask_javascript();

}  // namespace scarp::wasm
