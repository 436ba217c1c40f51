// A streamed height field that ends near a cut.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "grid/cut_rows.h"
#include "scarp/height_field.h"

namespace scarp::grid {

/// The samples of `source`, masked by CutRows::mask_beyond().
class CutSource final : public SampleSource {
 public:
  CutSource(const SampleSource& source, std::shared_ptr<const CutRows> cut) : source_(source), cut_(std::move(cut)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(source_.read(col, row, cols, rows, out, stride));
    cut_->mask_beyond(col, row, cols, rows, out, stride);
    return {};
  }
  bool is_in_memory() const override { return source_.is_in_memory(); }

 private:
  const SampleSource& source_;  // borrowed
  std::shared_ptr<const CutRows> cut_;
};

}  // namespace scarp::grid
