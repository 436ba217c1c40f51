#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/caught.h"
#include "base/memory_budget.h"
#include "base/parallel.h"
#include "base/reporter.h"
#include "features/hollow_samples.h"
#include "features/hollows.h"
#include "features/path_line.h"
#include "features/valley_paths.h"
#include "grid/line_marks.h"
#include "grid/samples.h"
#include "grid/vertex_lattice.h"
#include "lines/line_samples.h"
#include "scarp/features.h"

namespace scarp {
namespace {

/// Share of the max error within which lines follow the raster, so that their insertion as soft lines adds no bends.
constexpr double kRidgeShare = 0.5;

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
  line.kind = options.are_kept ? LineKind::kKeptRidge : LineKind::kRidge;
  line.name = std::move(name);
  for (const Point p : vertices) {
    line.points.push_back({affine[0] + affine[1] * p.x + affine[2] * p.y, affine[3] + affine[4] * p.x + affine[5] * p.y,
                           std::numeric_limits<double>::quiet_NaN()});
  }
  return line;
}

/// Segments near all samples within two samples of paths.
std::vector<geom::Segment> courses_of(const std::vector<features::ValleyPath>& paths) {
  std::vector<geom::Segment> courses;
  for (const features::ValleyPath& path : paths) {
    for (const Point p : path.samples) {
      for (const std::int32_t y : {p.y - 1, p.y})
        courses.push_back({{(p.x - 1) * grid::kLatticeSteps, y * grid::kLatticeSteps},
                           {(p.x + 1) * grid::kLatticeSteps, y * grid::kLatticeSteps}});
    }
  }
  return courses;
}

std::vector<grid::SampleRun> runs_of(const HeightField& field, const RidgeOptions& options) {
  grid::LineRuns runs(options.affine, field.cols, field.rows);
  for (const Line& line : options.avoid) runs.add_course(line);
  return runs.runs();
}

/// Detection on a raster and its negation.
class Detection {
 public:
  Detection(const HeightField& field, const RidgeOptions& options)
      : field_(field),
        options_(options),
        reporter_(options.run.progress),
        marks_(runs_of(field, options), field.rows),
        memory_{field.samples == nullptr ? options.run.memory.limit : 0, options.run.memory.taken, 0} {}

  Result<Ridges> run() {
    Ridges found;
    SCARP_TRY(found.valleys, find(false, "valley"));
    SCARP_TRY(found.ridges, find(true, "ridge"));
    for (const auto* lines : {&found.valleys, &found.ridges}) {
      for (const Line& line : *lines) found.vertices += line.points.size();
    }
    return found;
  }

 private:
  Result<std::vector<Line>> find(bool is_upside_down, const char* name) {
    return field_.samples != nullptr ? find_in_memory(is_upside_down, name) : find_in_source(is_upside_down, name);
  }

  Result<std::vector<Line>> find_in_memory(bool is_upside_down, const char* name) {
    SCARP_RETURN_IF_ERROR(take_step());
    SCARP_TRY(const auto& samples, grid::Samples::of(field_));
    grid::Raster raster = samples.raster();
    std::vector<float> turned;
    if (is_upside_down) {
      turned.assign(raster.samples, raster.row(raster.rows));
      for (float& height : turned) height = -height;
      raster.samples = turned.data();
    }
    const std::vector<features::Hollow> hollows = features::find_hollows(raster, options_.height, options_.run.threads);
    SCARP_RETURN_IF_ERROR(take_step());
    const std::vector<features::ValleyPath> paths =
        features::follow_valleys(raster, hollows, [&](Point p) { return marks_.has(p); });
    SCARP_RETURN_IF_ERROR(take_step());
    return draw(paths, lines::LineSamples(raster), name);
  }

  Result<std::vector<Line>> find_in_source(bool is_upside_down, const char* name) {
    SCARP_RETURN_IF_ERROR(take_step());
    features::HollowSamples::Question question;
    question.height = options_.height;
    question.is_upside_down = is_upside_down;
    question.is_left_out = [&](Point p) { return marks_.has(p); };
    question.threads = options_.run.threads;
    const std::uint64_t rows = features::HollowSamples::bytes(field_);
    question.check = [&, rows](std::uint64_t count, double share) {
      return memory_.check_part(lines_ + rows + kBytesPerSample * count, share, "ridges and valleys",
                                "a larger height of ridges");
    };
    SCARP_TRY(auto&& hollows, features::HollowSamples::find(field_, question));
    SCARP_RETURN_IF_ERROR(take_step());
    const std::vector<features::ValleyPath> paths = features::follow_valleys(hollows);
    hollows = {};
    SCARP_RETURN_IF_ERROR(take_step());
    SCARP_TRY(const auto& samples, lines::LineSamples::read(field_, courses_of(paths)));
    // Chords are the same on the raster and its negation.
    return draw(paths, samples, name);
  }

  std::vector<Line> draw(const std::vector<features::ValleyPath>& paths, const lines::LineSamples& samples,
                         const char* name) {
    std::vector<Line> lines(paths.size());
    parallel_for(paths.size(), options_.run.threads, [&](std::size_t k) {
      lines[k] = to_map(features::fewest_vertices(samples, paths[k], kRidgeShare * options_.max_error), options_,
                        fmt::format("{} {}", name, k + 1));
    });
    for (const Line& line : lines) lines_ += 2 * sizeof(Line) + sizeof(line.points[0]) * line.points.size();
    return lines;
  }

  Result<void> take_step() {
    constexpr double kSteps = 6;
    if (reporter_.report("ridges", steps_++ / kSteps, 0, 0)) return {};
    return fail(ErrorKind::kCancelled, "cancelled while looking for ridges");
  }

  static constexpr std::uint64_t kBytesPerSample = 48;  // near hollows

  const HeightField& field_;
  const RidgeOptions& options_;
  Reporter reporter_;
  grid::SampleSet marks_;
  MemoryBudget memory_;
  std::uint64_t lines_ = 0;  // bytes of lines found
  int steps_ = 0;
};

}  // namespace

Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options) try {
  SCARP_RETURN_IF_ERROR(check_ridges(options));
  SCARP_RETURN_IF_ERROR(grid::check_size(field));
  // The finer lattice of lines must fit.
  if (std::max(field.cols, field.rows) > kMaxCoordinate / grid::kLatticeSteps) return Ridges{};
  return Detection(field, options).run();
} catch (...) {
  return caught(ErrorKind::kInput, "look for ridges");
}

}  // namespace scarp
