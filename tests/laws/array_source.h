// Samples in memory, read in windows like a file's samples.
#pragma once

#include <cstddef>
#include <string>

#include "grid/window.h"
#include "scarp/height_field.h"

namespace scarp::testing {

/// Windows of an array; reads at or below `broken_row` fail.
class ArraySource : public SampleSource {
 public:
  explicit ArraySource(const HeightField& field, int broken_row = 1 << 30) : field_(field), broken_row_(broken_row) {}
  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    if (row + rows > broken_row_) return fail(ErrorKind::kInput, "row " + std::to_string(broken_row_) + " is broken");
    return grid::read_window(field_, col, row, cols, rows, out, stride);
  }
  bool is_in_memory() const override { return false; }

 private:
  HeightField field_;
  int broken_row_;
};

inline HeightField with_source(HeightField field, const SampleSource& source) {
  field.samples = nullptr;
  field.nodata.reset();
  field.source = &source;
  return field;
}

}  // namespace scarp::testing
