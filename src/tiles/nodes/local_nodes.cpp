// The nodes of a local grid: the samples of its raster.
#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/window.h"
#include "scarp/tile.h"

namespace scarp {
namespace {

/// Approximate number of samples visited at once.
constexpr std::int64_t kSamplesTogether = 1 << 20;

class LocalNodes final : public NodeSource {
 public:
  explicit LocalNodes(const HeightField& field) : field_(field) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    // Every step-th sample is a node. The outermost samples are repeated outside the raster.
    const std::int64_t step = window.grid.local.side / window.per_turn, bottom = window.last_row() * step;
    const auto column = [&](int i) {
      return static_cast<int>(std::clamp<std::int64_t>((window.col + i) * step, 0, field_.cols - 1));
    };
    const auto row = [&](int j) {
      const std::int64_t north = bottom - (window.row + j) * step;
      return static_cast<int>(field_.rows - 1 - std::clamp<std::int64_t>(north, 0, field_.rows - 1));
    };
    const int first = column(0), count = column(window.cols - 1) - first + 1;
    const int last_row = row(window.rows - 1);
    std::vector<float> samples;
    int held = 0, rows = 0;
    for (int j = 0; j < window.rows; ++j) {
      const int from = row(j);
      if (from >= held + rows) {
        held = from;
        rows = step == 1 ? last_row - from + 1 : 1;
        samples.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(rows));
        SCARP_RETURN_IF_ERROR(grid::read_window(field_, first, held, count, rows, samples.data(), count));
      }
      const float* const line = samples.data() + std::ptrdiff_t{from - held} * count;
      float* const nodes = out.data() + std::ptrdiff_t{j} * window.cols;
      for (int i = 0; i < window.cols; ++i) nodes[i] = line[column(i) - first];
    }
    return {};
  }

  bool has_samples() const override { return true; }

  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    const auto place = [](double at, int count) { return static_cast<int>(std::clamp(at, -1.0, count + 1.0)); };
    const int left = std::max(place(std::floor(box.west), field_.cols), 0);
    const int right = std::min(place(std::ceil(box.east), field_.cols), field_.cols - 1);
    const int top = std::max(field_.rows - 1 - place(std::ceil(box.north), field_.rows), 0);
    const int bottom = std::min(field_.rows - 1 - place(std::floor(box.south), field_.rows), field_.rows - 1);
    if (left > right) return {};
    const int cols = right - left + 1, together = static_cast<int>(std::max<std::int64_t>(1, kSamplesTogether / cols));
    std::vector<float> samples;
    for (int first = top; first <= bottom; first += together) {
      const int rows = std::min(together, bottom - first + 1);
      samples.resize(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
      SCARP_RETURN_IF_ERROR(grid::read_window(field_, left, first, cols, rows, samples.data(), cols));
      for (int j = 0; j < rows; ++j)
        visit({static_cast<double>(left),
               static_cast<double>(field_.rows - 1 - first - j),
               1,
               0,
               {samples.data() + std::ptrdiff_t{j} * cols, static_cast<std::size_t>(cols)}});
    }
    return {};
  }

 private:
  HeightField field_;
};

}  // namespace

std::unique_ptr<NodeSource> make_local_nodes(const HeightField& field) { return std::make_unique<LocalNodes>(field); }

}  // namespace scarp
