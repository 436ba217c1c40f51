#include <algorithm>
#include <utility>

#include "scarp/height_field.h"

namespace scarp {

namespace {

class EditedSource final : public SampleSource {
 public:
  EditedSource(std::shared_ptr<const SampleSource> source, std::vector<SampleEdit> edits)
      : source_(std::move(source)), edits_(std::move(edits)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(source_->read(col, row, cols, rows, out, stride));
    for (int y = 0; y < rows; ++y) {
      auto edit = std::lower_bound(edits_.begin(), edits_.end(), std::pair(row + y, col),
                                   [](const SampleEdit& e, const auto& at) { return std::pair(e.row, e.col) < at; });
      for (; edit != edits_.end() && edit->row == row + y && edit->col < col + cols; ++edit)
        out[y * stride + edit->col - col] = edit->after;
    }
    return {};
  }
  bool is_in_memory() const override { return source_->is_in_memory(); }

 private:
  std::shared_ptr<const SampleSource> source_;
  std::vector<SampleEdit> edits_;
};

}  // namespace

std::shared_ptr<const SampleSource> edit_source(std::shared_ptr<const SampleSource> source,
                                                std::vector<SampleEdit> edits) {
  return std::make_shared<EditedSource>(std::move(source), std::move(edits));
}

void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field) {
  if (field.source) {
    if (!edits.empty()) field.source = edit_source(field.source, edits);
    return;
  }
  if (!edits.empty()) field.own();
  for (const SampleEdit& edit : edits)
    field.samples[static_cast<std::size_t>(edit.row) * static_cast<std::size_t>(field.cols) +
                  static_cast<std::size_t>(edit.col)] = edit.after;
}

}  // namespace scarp
