#include "grid/sources/lake_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::grid {

namespace {

class LevelSource final : public SampleSource {
 public:
  LevelSource(std::shared_ptr<const SampleSource> source, std::vector<LevelRun> runs)
      : source_(std::move(source)), runs_(std::move(runs)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(source_->read(col, row, cols, rows, out, stride));
    for (int y = 0; y < rows; ++y) {
      auto run = std::partition_point(runs_.begin(), runs_.end(), [at = row + y, col](const LevelRun& before) {
        return before.samples.row < at || (before.samples.row == at && before.samples.end <= col);
      });
      for (; run != runs_.end() && run->samples.row == row + y && run->samples.begin < col + cols; ++run) {
        float* const samples = out + y * stride - col;
        for (int x = std::max(run->samples.begin, col); x < std::min(run->samples.end, col + cols); ++x) {
          const bool stays = std::isnan(samples[x]) || (run->only_raises && samples[x] > run->height);
          if (!stays) samples[x] = run->height;
        }
      }
    }
    return {};
  }
  bool is_in_memory() const override { return source_->is_in_memory(); }

 private:
  std::shared_ptr<const SampleSource> source_;
  std::vector<LevelRun> runs_;
};

}  // namespace

std::shared_ptr<const SampleSource> level_source(std::shared_ptr<const SampleSource> source,
                                                 std::vector<LevelRun> runs) {
  return std::make_shared<LevelSource>(std::move(source), std::move(runs));
}

}  // namespace scarp::grid
