#include "scarp/ridges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/caught.h"
#include "base/parallel.h"
#include "goals.h"
#include "grid/vertex_places.h"
#include "hollows.h"
#include "line_marks.h"
#include "path_line.h"
#include "refine/samples.h"
#include "valley_paths.h"

namespace scarp {
namespace {

/// Share of the max error within which lines follow the raster: what soft lines are laid with takes no more bends.
constexpr double kHeightShare = 0.5;

Result<void> check_ridges(const RidgeOptions& options) {
  if (!(options.height > 0 && std::isfinite(options.height)))
    return fail(ErrorKind::kUsage,
                fmt::format("the height of ridges must be a finite number above 0, not {}", options.height));
  if (!(options.max_error >= 0 && std::isfinite(options.max_error)))
    return fail(
        ErrorKind::kUsage,
        fmt::format("the max error beside ridges must be a finite number of at least 0, not {}", options.max_error));
  return {};
}

Line to_map(const std::vector<Point>& vertices, const RidgeOptions& options, std::string name) {
  const auto& affine = options.affine;
  Line line;
  line.polygon = options.are_kept ? kKeptRidgeLine : kRidgeLine;
  line.name = std::move(name);
  for (const Point p : vertices) {
    line.points.push_back({affine[0] + affine[1] * p.x + affine[2] * p.y, affine[3] + affine[4] * p.x + affine[5] * p.y,
                           std::numeric_limits<double>::quiet_NaN()});
  }
  return line;
}

/// Detection on a raster and on the same upside down.
class Detection {
 public:
  Detection(const Raster& raster, const RidgeOptions& options)
      : raster_(raster), options_(options), reporter_(options.progress) {
    if (options.avoid.empty()) return;
    marks_.emplace(options.affine, raster.cols, raster.rows);
    for (const Line& line : options.avoid) marks_->add_course(line);
  }

  Result<Ridges> run() {
    Ridges found;
    auto valleys = find(raster_, "valley");
    if (!valleys) return tl::unexpected(valleys.error());
    found.valleys = std::move(*valleys);
    std::vector<float> turned(raster_.samples, raster_.row(raster_.rows));
    for (float& height : turned) height = -height;
    auto ridges = find({turned.data(), raster_.cols, raster_.rows}, "ridge");
    if (!ridges) return tl::unexpected(ridges.error());
    found.ridges = std::move(*ridges);
    for (const auto* lines : {&found.valleys, &found.ridges}) {
      for (const Line& line : *lines) found.vertices += line.points.size();
    }
    return found;
  }

 private:
  Result<std::vector<Line>> find(const Raster& raster, const char* name) {
    if (auto goes_on = take_step(); !goes_on) return tl::unexpected(goes_on.error());
    const std::vector<Hollow> hollows = find_hollows(raster, options_.height, options_.threads);
    if (auto goes_on = take_step(); !goes_on) return tl::unexpected(goes_on.error());
    const std::vector<ValleyPath> paths =
        follow_valleys(raster, hollows, [&](std::size_t i) { return marks_ && marks_->has(i); });
    if (auto goes_on = take_step(); !goes_on) return tl::unexpected(goes_on.error());
    std::vector<Line> lines(paths.size());
    parallel_for(paths.size(), options_.threads, [&](std::size_t k) {
      lines[k] = to_map(fewest_vertices(raster, paths[k], kHeightShare * options_.max_error), options_,
                        fmt::format("{} {}", name, k + 1));
    });
    return lines;
  }

  Result<void> take_step() {
    constexpr double kSteps = 6;
    if (reporter_.report("ridges", steps_++ / kSteps, 0, 0)) return {};
    return fail(ErrorKind::kCancelled, "cancelled while looking for ridges");
  }

  const Raster& raster_;
  const RidgeOptions& options_;
  Reporter reporter_;
  std::optional<LineMarks> marks_;
  int steps_ = 0;
};

}  // namespace

Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options) try {
  if (auto sound = check_ridges(options); !sound) return tl::unexpected(sound.error());
  const auto samples = Samples::of(field);
  if (!samples) return tl::unexpected(samples.error());
  const Raster raster = samples->raster();
  // Lines on a finer lattice need room.
  if (std::max(raster.cols, raster.rows) > kMaxCoordinate / kLatticeSteps) return Ridges{};
  return Detection(raster, options).run();
} catch (...) {
  return caught(ErrorKind::kInput, "look for ridges");
}

}  // namespace scarp
