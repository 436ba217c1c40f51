// 16-bit samples in memory.
#include <cstddef>
#include <utility>

#include "scarp/height_field.h"

namespace scarp {
namespace {

class CodedSource : public SampleSource {
 public:
  CodedSource(std::vector<std::uint16_t> codes, int cols, std::vector<float> heights)
      : codes_(std::move(codes)), cols_(cols), heights_(std::move(heights)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    for (int y = 0; y < rows; ++y) {
      const std::uint16_t* from = codes_.data() + static_cast<std::ptrdiff_t>(row + y) * cols_ + col;
      float* to = out + y * stride;
      for (int x = 0; x < cols; ++x) to[x] = heights_[from[x]];
    }
    return {};
  }
  bool is_in_memory() const override { return true; }

 private:
  std::vector<std::uint16_t> codes_;
  int cols_;
  std::vector<float> heights_;
};

}  // namespace

std::unique_ptr<SampleSource> make_coded_source(std::vector<std::uint16_t> codes, int cols,
                                                std::vector<float> heights) {
  return std::make_unique<CodedSource>(std::move(codes), cols, std::move(heights));
}

}  // namespace scarp
