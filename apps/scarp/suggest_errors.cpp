// Greedy insertion visits meshes of every size on its way, so one run answers for all shares: the error to ask for is
// the smallest max error seen while the mesh was still within the share (max error is not monotone, and a run that is
// given that error stops at just that mesh).
//
// A large raster is sampled by windows. They are refined together, always the one with the largest error, so that rough
// windows get the vertices that flat ones do not need, as in the whole raster. Windows have more border for their area
// than the raster, which makes the estimate a little too large.
#include "suggest_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "scarp/simplify.h"

namespace scarp::cli {
namespace {

constexpr std::uint64_t kWholeLimit = 2'000'000;
constexpr int kWindowSide = 256;
constexpr int kMaxWindows = 16;

struct Window {
  std::vector<float> samples;  ///< empty for the whole field
  HeightField field;
};

/// First sample of the k-th of n windows of `side` samples, spread evenly over `length` samples.
int window_start(int k, int n, int side, int length) {
  const std::int64_t slack = length - side;
  return n == 1 ? static_cast<int>(slack / 2) : static_cast<int>(slack * k / (n - 1));
}

std::vector<Window> choose_windows(const HeightField& field) {
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  if (samples <= kWholeLimit) return {Window{{}, field}};
  const int width = std::min(field.cols, kWindowSide), height = std::min(field.rows, kWindowSide);
  int down = std::clamp(field.rows / height, 1, 4);
  const int across = std::clamp(field.cols / width, 1, kMaxWindows / down);
  down = std::clamp(field.rows / height, 1, kMaxWindows / across);

  std::vector<Window> windows;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const int col0 = window_start(i, across, width, field.cols), row0 = window_start(j, down, height, field.rows);
      Window window;
      window.samples.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
      for (int row = row0; row < row0 + height; ++row) {
        const float* first =
            field.samples + static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) + col0;
        window.samples.insert(window.samples.end(), first, first + width);
      }
      window.field = {window.samples.data(), width, height, field.nodata, grid_frame(height), 0};
      windows.push_back(std::move(window));
    }
  }
  return windows;
}

/// The windows under refinement, as if they were one raster.
class JointRefiner {
 public:
  void add(Refiner refiner) {
    triangles_ += refiner.triangle_count();
    vertices_ += refiner.vertex_count();
    by_error_.push({refiner.max_error(), refiners_.size()});
    refiners_.push_back(std::move(refiner));
  }
  bool empty() const { return refiners_.empty(); }
  std::uint64_t triangles() const { return triangles_; }
  std::uint64_t vertices() const { return vertices_; }
  double max_error() const { return by_error_.top().first; }

  bool insert_worst() {
    const std::size_t worst = by_error_.top().second;
    Refiner& refiner = refiners_[worst];
    triangles_ -= refiner.triangle_count();
    const bool inserted = refiner.insert_worst();
    triangles_ += refiner.triangle_count();
    if (!inserted) return false;
    ++vertices_;
    by_error_.pop();
    by_error_.push({refiner.max_error(), worst});
    return true;
  }

 private:
  std::vector<Refiner> refiners_;
  std::priority_queue<std::pair<double, std::size_t>> by_error_;
  std::uint64_t triangles_ = 0, vertices_ = 0;
};

}  // namespace

Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress) {
  const std::vector<Window> windows = choose_windows(field);
  Suggestions suggestions;
  suggestions.is_estimate = !windows.front().samples.empty();
  JointRefiner joint;
  std::uint64_t full = 0;
  for (const Window& window : windows) {
    Result<Refiner> refiner = Refiner::create(window.field);
    if (!refiner && refiner.error().kind == ErrorKind::kInput && windows.size() > 1) continue;  // a window of voids
    if (!refiner) return tl::unexpected(std::move(refiner.error()));
    const auto cols = static_cast<std::uint64_t>(window.field.cols),
               rows = static_cast<std::uint64_t>(window.field.rows);
    full += 2 * (cols - 1) * (rows - 1);
    suggestions.samples_used += cols * rows;
    joint.add(std::move(*refiner));
  }
  if (joint.empty()) {
    for (const double share : shares) suggestions.rows.push_back({share, std::nullopt});
    return suggestions;
  }

  const double last_target = shares.back() * static_cast<double>(full);
  double smallest = std::numeric_limits<double>::infinity();
  std::uint64_t steps = 0;
  bool more = true;
  for (const double share : shares) {
    const double target = share * static_cast<double>(full);
    while (more && static_cast<double>(joint.triangles()) <= target) {
      smallest = std::min(smallest, joint.max_error());
      more = smallest > 0 && joint.insert_worst();
      if (++steps % 512 != 0) continue;
      const Progress now{"estimate", static_cast<double>(joint.triangles()) / last_target, joint.vertices(),
                         joint.max_error()};
      if (!progress(now)) return fail(ErrorKind::kCancelled, "interrupted");
    }
    suggestions.rows.push_back({share, std::isfinite(smallest) ? std::optional(smallest) : std::nullopt});
  }
  return suggestions;
}

}  // namespace scarp::cli
