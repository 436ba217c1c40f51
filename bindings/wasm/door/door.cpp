#include "door.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string>

#include "scarp/height_field.h"
#include "scarp/version.h"

extern "C" {
/// Returns 0, or another value to cancel.
__attribute__((import_module("scarp"), import_name("progress"))) std::int32_t scarp_progress(const char* pass,
                                                                                             double fraction,
                                                                                             double vertices,
                                                                                             double max_error);
}

namespace scarp::wasm {
namespace {

Error& last_error() {
  static Error error;
  return error;
}

}  // namespace

void keep(const Error& error) { last_error() = error; }

void keep_exception() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    last_error().kind = ErrorKind::kMemory;
    last_error().message = "out of memory";  // short enough for no allocation
  } catch (const std::exception& error) {
    keep({ErrorKind::kInternal, std::string("internal error: ") + error.what() + "; please report it"});
  } catch (...) {
    keep({ErrorKind::kInternal, "internal error: an unknown exception; please report it"});
  }
}

std::array<double, 6> affine_of(const Field& given) {
  const double* const gt = given.geotransform;
  return {gt[0] + gt[1] / 2 + gt[2] / 2, gt[1], gt[2], gt[3] + gt[4] / 2 + gt[5] / 2, gt[4], gt[5]};
}

Result<HeightField> take_field(const Field& given) {
  HeightField field;
  field.samples = at<const float>(given.samples);
  field.cols = static_cast<int>(given.cols);
  field.rows = static_cast<int>(given.rows);
  if (given.nodata == given.nodata) field.nodata = static_cast<float>(given.nodata);
  field.sample_rounding = given.sample_rounding;
  if (given.place == 0) {
    field.frame = grid_frame(field.rows);
    return field;
  }
  const std::array<double, 6> affine = affine_of(given);
  field.frame.affine = affine;
  const bool is_finite = std::all_of(affine.begin(), affine.end(), [](double term) { return std::isfinite(term); });
  if (!is_finite || !std::isnormal(field.frame.determinant()))
    return fail(ErrorKind::kUsage, "the transform maps the samples to a line or to infinity");
  if (given.place == 1) {
    field.frame.kind = Frame::Kind::kSource;
    return field;
  }
  SCARP_TRY(field.frame, frame_of_degrees(affine, field.cols, field.rows));
  return field;
}

ProgressCallback ask_javascript() {
  return [](const Progress& progress) {
    const std::string pass(progress.pass);
    return scarp_progress(pass.c_str(), progress.fraction, static_cast<double>(progress.vertices),
                          progress.max_error) == 0;
  };
}

}  // namespace scarp::wasm

SCARP_EXPORT(scarp_error_kind) std::int32_t scarp_error_kind() {
  return static_cast<std::int32_t>(scarp::wasm::last_error().kind);
}
SCARP_EXPORT(scarp_error_text) const char* scarp_error_text() { return scarp::wasm::last_error().message.c_str(); }
SCARP_EXPORT(scarp_version) const char* scarp_version() { return scarp::version(); }
SCARP_EXPORT(scarp_allocate) void* scarp_allocate(std::size_t bytes) { return std::malloc(bytes); }
SCARP_EXPORT(scarp_release) void scarp_release(void* block) { std::free(block); }
