#include "simplify/line_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "grid/bands.h"
#include "grid/source_failure.h"
#include "pieces/effort.h"
#include "pieces/goals.h"
#include "simplify/search_progress.h"

namespace scarp {

namespace {

/// An error, and what share of the budget its mesh takes; logarithms.
struct LineSight {
  double error = 0, used = 0;
};

class LineErrorSearch {
 public:
  LineErrorSearch(const SimplifyOptions& options, const RunOnce& run)
      : options_(options),
        run_(run),
        budget_(options),
        progress_(options.run.progress),
        floor_(options.goals.max_error.value_or(0)) {}

  Result<Simplified> execute(double most) {
    const auto start = Clock::now();
    if (auto begun = begin(std::max(most, floor_)); !begun) return tl::unexpected(begun.error());
    while (!has_ended()) {
      if (auto looked = look(guess()); !looked) return tl::unexpected(looked.error());
    }
    best_.stop = stop_of_best();
    others_.seconds = seconds_since(start) - best_.seconds_refine - best_.seconds_measure;
    best_.seconds_refine += others_.seconds;
    best_.passes.insert(best_.passes.begin(), others_);
    return std::move(best_);
  }

 private:
  static constexpr double kAim = 0.995, kFull = 0.99, kNearlyFull = 0.97;  // shares of the budget
  static constexpr int kPatience = 5;                                      // runs before nearly full will do
  static constexpr double kClosed = 0.002, kNearFloor = 0.02;              // logarithms of the errors' ratio

  /// The lines alone.
  Result<void> begin(double most) {
    auto least = run(most, 0.1);
    if (!least) return tl::unexpected(least.error());
    const MeshSize size{least->mesh.vertex_count(), least->mesh.triangle_count()};
    const char* culprit = has_lines(options_) ? "the lines and the outline of the valid data alone need"
                          : options_.quality.shape.any()
                              ? "the angles and edges alone need"
                              : "the outline of the valid data and its rows of tiles alone need";
    if (auto fits = budget_.check(size, culprit, ""); !fits) return fits;
    best_ = std::move(*least);
    is_at_floor_ = best_.measurement.max_error <= floor_;
    least_error_ = std::log(std::max(best_.measurement.max_error, std::numeric_limits<double>::min()));
    fits_ = {least_error_, used_by(best_)};
    return {};
  }

  bool has_ended() const {
    const double enough = std::log(runs_ < kPatience ? kFull : kNearlyFull);
    return is_at_floor_ || runs_ == kMostLineRuns || fits_.used >= enough ||
           (exceeds_ && fits_.error - exceeds_->error < kClosed);
  }

  /// Along the power that was seen last while all runs fit, else between those that fit and those that do not.
  double guess() const {
    const double aim = std::log(kAim);
    if (!exceeds_) {
      const double farthest = std::log(32.0);
      const double error =
          std::clamp(fits_.error + (fits_.used - aim) / power_, fits_.error - farthest, fits_.error - kClosed);
      constexpr double kFarBelow = 0x1p-20;  // of the lines' own error: an exact mesh is likely to fit
      const bool is_floor =
          floor_ > 0 ? error <= std::log(floor_) + kNearFloor : error <= least_error_ + std::log(kFarBelow);
      return is_floor ? floor_ : std::exp(error);
    }
    const double width = fits_.error - exceeds_->error;
    double error = fits_.error - width / 2;
    if (std::isfinite(exceeds_->used)) {
      // An end that stays weighs less and less.
      const double weight = std::pow(0.5, std::max(0, stays_ - 1));
      double below = fits_.used - aim, above = exceeds_->used - aim;
      (last_fits_ ? above : below) *= weight;
      if (below < 0 && above > 0) error = (exceeds_->error * -below + fits_.error * above) / (above - below);
    }
    return std::exp(std::clamp(error, exceeds_->error + width / 20, fits_.error - width / 20));
  }

  Result<void> look(double error) {
    ++runs_;
    auto made = run(error, 0.3);
    if (!made && made.error().kind != ErrorKind::kPromise) return tl::unexpected(made.error());
    const double used = made ? used_by(*made) : std::numeric_limits<double>::infinity();
    const bool fits = used <= 0;
    stays_ = runs_ > 1 && fits == last_fits_ ? stays_ + 1 : 1;
    last_fits_ = fits;
    constexpr double kFarBelow = 0x1p-20;
    const double reached = made ? std::min(error, made->measurement.max_error) : error;
    const LineSight here{fits || error > 0
                             ? std::log(std::max(fits ? reached : error, std::numeric_limits<double>::min()))
                             : fits_.error + std::log(kFarBelow),
                         used};
    if (std::isfinite(used) && std::abs(fits_.error - here.error) > kNearFloor)
      power_ = std::clamp((here.used - fits_.used) / (fits_.error - here.error), 0.3, 20.0);
    if (!fits) {
      if (made) add_work(*made, others_);
      exceeds_ = here;
      return {};
    }
    fits_ = here;
    is_at_floor_ = error == floor_ || reached <= floor_;
    if (!is_at_floor_ && rank(*made) >= rank(best_)) {
      add_work(*made, others_);
      return {};
    }
    add_work(best_, others_);
    best_ = std::move(*made);
    return {};
  }

  static std::tuple<double, double, std::uint64_t> rank(const Simplified& made) {
    return {made.measurement.max_error, made.measurement.rmse, made.mesh.triangle_count()};
  }

  StopReason stop_of_best() const {
    if (is_at_floor_ || best_.measurement.max_error <= floor_)
      return options_.goals.max_error ? StopReason::kMaxError : StopReason::kExact;
    const MeshSize vertices{best_.mesh.vertex_count(), 0}, triangles{0, best_.mesh.triangle_count()};
    return budget_.used(vertices) > budget_.used(triangles) ? StopReason::kMaxVertices : StopReason::kMaxTriangles;
  }

  Result<Simplified> run(double error, double share) {
    if (!progress_.begin(share)) return fail(ErrorKind::kCancelled, "cancelled while searching an error");
    SimplifyOptions options = options_;
    options.goals.max_triangles = options.goals.max_vertices = std::nullopt;
    options.goals.max_error = error;
    options.goals.objective = Objective::kMax;  // of the search, not of a run
    options.run.progress = progress_.of_run(false);
    constexpr std::uint64_t kBytesPerVertex = 48;
    options.run.memory.taken += kBytesPerVertex * best_.mesh.vertex_count();
    return run_(options);
  }

  /// The logarithm of the share.
  double used_by(const Simplified& made) const {
    return std::log(budget_.used({made.mesh.vertex_count(), made.mesh.triangle_count()}));
  }

  const SimplifyOptions& options_;
  const RunOnce& run_;
  Budget budget_;
  SearchProgress progress_;
  double floor_;  // the least error that is of use
  Simplified best_;
  double least_error_ = 0;    // of the lines alone; a logarithm
  int runs_ = 0, stays_ = 0;  // but the first; of them the last, on one side of the budget
  bool last_fits_ = true, is_at_floor_ = false;
  double power_ = 1;  // triangles ~ error^-power, where nothing is known yet
  LineSight fits_;
  std::optional<LineSight> exceeds_;
  Pass others_{"search"};
};

/// Throws SourceFailure.
HeightRange read_range(const HeightField& field) {
  HeightRange range;
  auto swept = sweep_rows(field, 0, [&](const RowRange& rows) -> Result<void> {
    HeightField part = field;
    part.samples = rows.samples.samples;
    part.rows = rows.samples.rows;
    const HeightRange here = height_range(part);
    if (here.valid == 0) return {};
    range.min = range.valid == 0 ? here.min : std::min(range.min, here.min);
    range.max = range.valid == 0 ? here.max : std::max(range.max, here.max);
    range.valid += here.valid;
    return {};
  });
  if (!swept) throw SourceFailure{swept.error()};
  return range;
}

}  // namespace

Result<Simplified> search_line_error(const SimplifyOptions& options, double most, const RunOnce& run) {
  return LineErrorSearch(options, run).execute(most);
}

double largest_line_error(const HeightField& field, const SimplifyOptions& options) {
  const HeightRange samples = field.samples != nullptr ? height_range(field) : read_range(field);
  double low = samples.min, high = samples.max;
  for (const Line& line : options.features.breaklines.lines) {
    for (const auto& point : line.points) {
      if (std::isnan(point[2])) continue;
      low = std::min(low, point[2]);
      high = std::max(high, point[2]);
    }
  }
  return 2 * (high - low);
}

}  // namespace scarp
