// Greedy insertion makes meshes of every size, so one run gives the curve of the smallest max error by the number of
// triangles (the max error is not monotone, and a run towards that error stops at just that mesh). A default run, with
// its own order and removal, needs about half of the triangles. One such run measures the ratio, and the curve then
// gives the error for a number of triangles. The ratio hardly changes from share to share, so most shares need one run.
//
// A large raster is sampled by windows. They are refined together, always the one with the largest error, so that rough
// windows have the vertices that flat windows do not need, as in the whole raster. Windows have more border for their
// area than the raster, so the estimate is a little too large.
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string_view>
#include <utility>

#include "scarp/simplify.h"

namespace scarp {
namespace {

constexpr std::uint64_t kWholeLimit = 2'000'000;
constexpr int kWindowSide = 256;
constexpr int kMaxWindows = 16;
constexpr std::string_view kPass = "estimate";
constexpr double kGreedyPart = 0.5;  // share of the pass
// Usual and least ratio of a default run's triangles to those of greedy insertion.
constexpr double kUsualRatio = 0.52, kLeastRatio = 0.35;

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
  if (samples <= kWholeLimit) {
    Window whole{{}, field};
    whole.field.channels.clear();
    return {whole};
  }
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
      window.field = {window.samples.data(), width, height, field.nodata, grid_frame(height), field.sample_rounding};
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

/// Rounds up to three significant digits: a goal that is a little too small would miss its share.
double round_up(double error) {
  if (error <= 0) return 0;
  const double digits = std::pow(10.0, 2 - std::floor(std::log10(error)));
  return std::ceil(error * digits * (1 - 1e-12)) / digits;
}

struct GreedyMesh {
  std::uint64_t triangles;
  double smallest_error;  ///< max error of this mesh, less than that of all previous meshes
};

/// The meshes of greedy insertion that are better than all previous ones.
class GreedyCurve {
 public:
  /// Refines until there are more than `most` triangles.
  Result<void> follow(JointRefiner& joint, double most, const ProgressCallback& progress) {
    std::uint64_t steps = 0;
    for (bool more = true; more && static_cast<double>(joint.triangles()) <= most;) {
      if (meshes_.empty() || joint.max_error() < meshes_.back().smallest_error)
        meshes_.push_back({joint.triangles(), joint.max_error()});
      more = joint.max_error() > 0 && joint.insert_worst();
      if (++steps % 512 != 0) continue;
      const Progress now{kPass, kGreedyPart * static_cast<double>(joint.triangles()) / most, joint.vertices(),
                         joint.max_error()};
      if (progress && !progress(now)) return fail(ErrorKind::kCancelled, "interrupted");
    }
    return {};
  }

  /// The largest of these meshes with at most `triangles` triangles; null if there is none.
  const GreedyMesh* find_within(double triangles) const {
    const auto beyond = std::partition_point(meshes_.begin(), meshes_.end(), [triangles](const GreedyMesh& mesh) {
      return static_cast<double>(mesh.triangles) <= triangles;
    });
    return beyond == meshes_.begin() ? nullptr : &*std::prev(beyond);
  }

 private:
  std::vector<GreedyMesh> meshes_;
};

/// Triangles of the windows' meshes in default runs; infinity if no mesh can satisfy the error.
Result<double> count_triangles(const std::vector<Window>& windows, double error, const ProgressCallback& progress) {
  SimplifyOptions options;
  options.goals.max_error = error;
  options.run.progress = progress;
  double triangles = 0;
  for (const Window& window : windows) {
    const Result<Simplified> simplified = simplify(window.field, options);
    if (!simplified && simplified.error().kind == ErrorKind::kPromise) return std::numeric_limits<double>::infinity();
    SCARP_RETURN_IF_ERROR(simplified);
    triangles += static_cast<double>(simplified->mesh.triangle_count());
  }
  return triangles;
}

/// Finds the errors, coarse ones first, with which default runs stay within given numbers of triangles.
class ShareSearch {
 public:
  ShareSearch(const std::vector<Window>& windows, const GreedyCurve& curve, double sample_rounding)
      : windows_(windows), curve_(curve), sample_rounding_(sample_rounding) {}

  Result<std::optional<double>> find(double target, const ProgressCallback& progress) {
    double aim = target / ratio_, tried = -1, fitting = 0, exceeding = std::numeric_limits<double>::infinity();
    std::optional<double> found;
    double margin = kMargin;
    for (int looks = 0; !found || looks < kMostLooks;) {
      const GreedyMesh* mesh = curve_.find_within(aim);
      if (mesh == nullptr) return found;
      aim = static_cast<double>(mesh->triangles);
      const double error = round_up(mesh->smallest_error + sample_rounding_);
      if (error == tried && found) return found;
      if (error == tried) {
        aim -= 1;
        continue;
      }
      tried = error;
      ++looks;
      SCARP_TRY(const double triangles, count_triangles(windows_, error, progress));
      ratio_ = std::isfinite(triangles) ? triangles / aim : 1;
      if (triangles <= target) {
        found = error;
        fitting = aim;
        if (triangles >= kUse * target) return found;
        aim = target / ratio_;
      } else {
        exceeding = aim;
        aim = std::min(aim, target / ratio_) * (1 - margin);
        margin = std::min(2 * margin, 0.5);
      }
      // If the ratio leads out of the known range, the middle is tried.
      if (found && !(fitting < aim && aim < exceeding)) aim = (fitting + exceeding) / 2;
    }
    return found;
  }

 private:
  static constexpr double kMargin = 0.002;  ///< towards fewer triangles if the ratio did not suffice; then doubled
  static constexpr double kUse = 0.9;
  static constexpr int kMostLooks = 6;  ///< most runs once one fits

  const std::vector<Window>& windows_;
  const GreedyCurve& curve_;
  const double sample_rounding_;
  double ratio_ = kUsualRatio;  ///< last ratio of a default run's triangles to those of greedy insertion
};

Result<void> check_request(const HeightField& field, std::span<const double> shares) {
  if (field.samples == nullptr)
    return fail(ErrorKind::kUsage, "errors are suggested for samples in memory: read the raster as a whole");
  double last = 0;
  for (const double share : shares) {
    if (!(share > last) || share > 1)
      return fail(ErrorKind::kUsage, "shares of the full grid's triangles must ascend, above 0 and at most 1");
    last = share;
  }
  if (shares.empty()) return fail(ErrorKind::kUsage, "no share of the full grid's triangles was given");
  return {};
}

}  // namespace

Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress) {
  SCARP_RETURN_IF_ERROR(check_request(field, shares));
  std::vector<Window> windows = choose_windows(field);
  Suggestions suggestions;
  suggestions.is_estimate = !windows.front().samples.empty();
  JointRefiner joint;
  std::uint64_t full = 0;
  std::vector<Window> valid;
  for (Window& window : windows) {
    Result<Refiner> refiner = Refiner::create(window.field);
    const auto cols = static_cast<std::uint64_t>(window.field.cols),
               rows = static_cast<std::uint64_t>(window.field.rows);
    const bool is_nodata = !refiner && refiner.error().kind == ErrorKind::kInput && windows.size() > 1;
    if (is_nodata) continue;
    SCARP_RETURN_IF_ERROR(refiner);
    full += 2 * (cols - 1) * (rows - 1);
    suggestions.samples_used += cols * rows;
    joint.add(std::move(*refiner));
    valid.push_back(std::move(window));
  }
  if (joint.empty()) {
    for (const double share : shares) suggestions.rows.push_back({share, std::nullopt});
    return suggestions;
  }

  GreedyCurve curve;
  SCARP_RETURN_IF_ERROR(curve.follow(joint, shares.back() / kLeastRatio * static_cast<double>(full), progress));
  joint = {};
  ShareSearch search(valid, curve, field.sample_rounding);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double done = static_cast<double>(k) / static_cast<double>(shares.size());
    const double fraction = kGreedyPart + (1 - kGreedyPart) * done;
    const auto report = [&](const Progress& now) {
      return !progress || progress({kPass, fraction, now.vertices, now.max_error});
    };
    SCARP_TRY(const auto& error, search.find(shares[k] * static_cast<double>(full), report));
    suggestions.rows.push_back({shares[k], error});
  }
  return suggestions;
}

}  // namespace scarp
