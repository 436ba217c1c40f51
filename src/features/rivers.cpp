#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "grid/affine_map.h"
#include "grid/line_marks.h"
#include "grid/raster.h"
#include "grid/sample_runs.h"
#include "grid/samples.h"
#include "lines/breaklines.h"
#include "lines/line_samples.h"
#include "lines/profile.h"
#include "scarp/features.h"

namespace scarp {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

bool is_closed(const Line& line) {
  const auto &first = line.points.front(), &last = line.points.back();
  return line.is_ring() || (first[0] == last[0] && first[1] == last[1]);
}

/// The raster's surface, with lakes enlarged by a sample.
class Ground {
 public:
  Ground(lines::LineSamples samples, std::span<const Lake> lakes, const std::array<double, 6>& affine)
      : samples_(std::move(samples)), to_samples_(affine) {
    if (lakes.empty()) return;
    grid::LineRuns runs(affine, samples_.cols(), samples_.rows());
    for (const Lake& lake : lakes) {
      runs.add_polygons(lake.shore);
      for (const Line& ring : lake.shore) runs.add_course(ring, 1.0 / 128);
    }
    lakes_.emplace(runs.runs(), samples_.rows());
  }

  grid::SamplePosition position_of(const std::array<double, 3>& point) const {
    return to_samples_.position(point[0], point[1]);
  }

  struct Surface {
    double height = kNoHeight;  // none outside the surface
    bool is_lake = false;
  };
  Surface at(const std::array<double, 3>& point) const {
    const auto [col, row] = position_of(point);
    if (!(col >= 0 && row >= 0 && col <= samples_.cols() - 1 && row <= samples_.rows() - 1)) return {};
    const double water = lakes_ ? level_around(col, row) : kNoHeight;
    if (!std::isnan(water)) return {water, true};
    return {static_cast<float>(lines::surface_at(samples_, {col, row})), false};
  }

 private:
  /// The level of the lowest lake with a sample in this cell.
  double level_around(double col, double row) const {
    double level = kNoHeight;
    for (const double y : {std::floor(row), std::ceil(row)}) {
      for (const double x : {std::floor(col), std::ceil(col)}) {
        const Point p{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
        if (lakes_->has(p) && samples_.is_valid(p)) level = std::fmin(level, double{samples_.at(p)});
      }
    }
    return level;
  }

  lines::LineSamples samples_;
  grid::MapToSamples to_samples_;
  std::optional<grid::SampleSet> lakes_;
};

/// A line with two positions per raster step.
class Course {
 public:
  Course(const Line& line, const Ground& ground) : line_(&line) {
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      vertices_.push_back(places_.size());
      places_.push_back({line.points[k][0], line.points[k][1], kNoHeight});
      if (k + 1 == line.points.size()) break;
      const auto p = ground.position_of(line.points[k]), q = ground.position_of(line.points[k + 1]);
      constexpr double kMostLooks = 1 << 20;
      const double looks = std::min(std::ceil(2 * std::hypot(q.col - p.col, q.row - p.row)), kMostLooks);
      for (double i = 1; i < looks; ++i) {
        const auto between = [&](std::size_t axis) {
          return line.points[k][axis] + i / looks * (line.points[k + 1][axis] - line.points[k][axis]);
        };
        places_.push_back({between(0), between(1), kNoHeight});
      }
    }
    for (auto& place : places_) {
      const Ground::Surface surface = ground.at(place);
      place[2] = surface.height;
      heights_.push_back(surface.height);
      is_lake_.push_back(surface.is_lake);
    }
    const auto is_height = [](double height) { return !std::isnan(height); };
    const auto first = std::find_if(heights_.begin(), heights_.end(), is_height);
    if (first == heights_.end()) return;
    const auto last = std::find_if(heights_.rbegin(), heights_.rend(), is_height);
    source_ = std::max(*first, *last);
    is_turned_ = *first < *last;
  }

  double source() const { return source_; }  ///< kNoHeight: the line has no height anywhere

  /// Lowers the water to shared vertices that are lower, and lowers shared vertices that are higher. Returns true if a
  /// shared vertex became lower.
  bool flow(std::map<std::array<double, 2>, double>& levels) {
    double level = std::numeric_limits<double>::infinity();
    bool has_lowered = false;
    std::size_t vertex = 0;
    for (std::size_t step = 0; step < places_.size(); ++step) {
      const std::size_t i = is_turned_ ? places_.size() - 1 - step : step;
      const bool is_vertex = vertices_[is_turned_ ? vertices_.size() - 1 - vertex : vertex] == i;
      if (is_vertex) ++vertex;
      if (std::isnan(heights_[i])) continue;
      level = std::min(level, heights_[i]);
      if (is_lake_[i]) continue;
      if (is_vertex) {
        double& shared = levels.try_emplace({places_[i][0], places_[i][1]}, level).first->second;
        has_lowered = has_lowered || level < shared;
        level = shared = std::min(shared, level);
      }
      heights_[i] = level;
    }
    return has_lowered;
  }

  River river(double tolerance) const {
    River river;
    river.name = line_->name;
    river.is_turned = is_turned_;
    river.course = *line_;
    river.course.kind = LineKind::kRiver;
    river.course.points.clear();
    const std::vector<std::size_t> kept = fixed_places();
    for (std::size_t k = 0; k < kept.size(); ++k) {
      add(kept[k], river);
      if (k + 1 == kept.size()) break;
      const auto from = heights_.begin() + static_cast<std::ptrdiff_t>(kept[k]),
                 to = heights_.begin() + static_cast<std::ptrdiff_t>(kept[k + 1]) + 1;
      for (const std::size_t bend : lines::find_bends({from, to}, tolerance)) add(kept[k] + bend, river);
    }
    river.mouth = std::numeric_limits<double>::infinity();
    river.source = -river.mouth;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (std::isnan(heights_[i])) continue;
      river.source = std::max(river.source, heights_[i]);
      river.mouth = std::min(river.mouth, heights_[i]);
      river.deepest_cut = std::max(river.deepest_cut, places_[i][2] - heights_[i]);
    }
    return river;
  }

 private:
  /// The line's vertices, the last positions outside lakes and the first ones inside, so that the line stays at the
  /// level of each lake.
  std::vector<std::size_t> fixed_places() const {
    std::vector<std::size_t> fixed = vertices_;
    for (std::size_t i = 1; i < places_.size(); ++i) {
      if (is_lake_[i - 1] != is_lake_[i]) fixed.insert(fixed.end(), {i - 1, i});
    }
    std::sort(fixed.begin(), fixed.end());
    fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
    return fixed;
  }

  void add(std::size_t i, River& river) const {
    river.course.points.push_back({places_[i][0], places_[i][1], heights_[i]});
  }

  const Line* line_;
  std::vector<std::array<double, 3>> places_;  // with the raster's heights
  std::vector<std::size_t> vertices_;          // vertices of the line, as indices of places_
  std::vector<double> heights_;                // water levels
  std::vector<bool> is_lake_;
  double source_ = kNoHeight;
  bool is_turned_ = false;
};

/// Samples near the lines: read from the field's source, or from memory through `held`.
Result<lines::LineSamples> samples_along(const HeightField& field, std::span<const Line> lines,
                                         const std::array<double, 6>& affine, std::optional<grid::Samples>& held) {
  if (field.samples != nullptr) {
    SCARP_TRY(held, grid::Samples::of(field));
    return lines::LineSamples(held->raster());
  }
  SCARP_RETURN_IF_ERROR(grid::check_size(field));
  SCARP_TRY(const auto& courses, lines::find_courses(lines, affine, field.cols, field.rows));
  return lines::LineSamples::read(field, courses);
}

}  // namespace

Result<std::vector<River>> carve_rivers(const HeightField& field, std::span<const Line> lines,
                                        std::span<const Lake> lakes, const RiverOptions& options) {
  if (!(options.tolerance >= 0))
    return fail(ErrorKind::kUsage,
                fmt::format("the tolerance of rivers must be at least 0, not {}", options.tolerance));
  std::optional<grid::Samples> held;
  SCARP_TRY(auto&& samples, samples_along(field, lines, options.affine, held));
  const Ground ground(std::move(samples), lakes, options.affine);
  std::vector<Course> courses;
  for (const Line& line : lines) {
    if (is_closed(line)) continue;
    Course course(line, ground);
    if (!std::isnan(course.source())) courses.push_back(std::move(course));
  }
  // A start at the highest source settles most of a network in one pass.
  std::vector<std::size_t> order(courses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return courses[a].source() > courses[b].source(); });
  std::map<std::array<double, 2>, double> levels;
  for (bool has_lowered = true; has_lowered;) {
    has_lowered = false;
    for (const std::size_t i : order) has_lowered = courses[i].flow(levels) || has_lowered;
  }
  std::vector<River> rivers;
  rivers.reserve(courses.size());
  for (const Course& course : courses) rivers.push_back(course.river(options.tolerance));
  return rivers;
}

}  // namespace scarp
