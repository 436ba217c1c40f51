#include "simplify/error_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "pieces/goals.h"
#include "simplify/search_progress.h"

namespace scarp {

namespace {

constexpr double kAim = 0.995;        // share of the budget: below it by about what a run scatters
constexpr double kFull = 0.99;        // enough to stop at once
constexpr double kNearlyFull = 0.97;  // enough after kFullPatience runs
constexpr int kFullPatience = 4;
constexpr double kClosed = 0.002;       // logarithm of the bounds' ratio
constexpr double kUsualPower = 1.3;     // triangles ~ error^-power, where nothing is known yet
constexpr double kFarBelow = 1.0 / 64;  // of greedy's error: below it an exact mesh is likely to fit
constexpr double kNearFloor = 0.02;     // logarithm: so near a goal it is tried itself

/// A bound, and what share of the budget the mesh for it takes; logarithms.
struct Sight {
  double error = 0, used = 0;
};

/// Minus the slope of the line through both, as far as it can be believed.
double power_between(const Sight& a, const Sight& b) {
  const double run = a.error - b.error;
  return run == 0 ? kUsualPower : std::clamp((b.used - a.used) / run, 0.3, 20.0);
}

class ErrorSearch {
 public:
  ErrorSearch(const SimplifyOptions& options, const RunOnce& run, Judged judged)
      : options_(options),
        run_(run),
        judged_(judged),
        budget_(options),
        progress_(options.run.progress),
        floor_(options.goals.max_error.value_or(0)) {}

  Result<Simplified> execute() {
    const auto start = Clock::now();
    if (auto begun = begin_greedily(); !begun) return tl::unexpected(begun.error());
    if (auto searched = search(); !searched) return tl::unexpected(searched.error());
    // The greedy mesh may have been searched for, too.
    if (!best_.passes.empty() && best_.passes.front().name == others_.name) {
      add_work(best_.passes.front(), others_);
      best_.seconds_refine -= best_.passes.front().seconds;
      best_.passes.erase(best_.passes.begin());
    }
    best_.passes.insert(best_.passes.begin(), others_);
    best_.passes.front().seconds = seconds_since(start) - best_.seconds_refine - best_.seconds_measure;
    best_.seconds_refine += best_.passes.front().seconds;
    return std::move(best_);
  }

 private:
  /// The refusal of a budget that is too small is that of this run.
  Result<void> begin_greedily() {
    auto made = run(without_effort(options_), 0.1);
    if (!made) return tl::unexpected(made.error());
    best_ = std::move(*made);
    has_room_ =
        best_.stop == StopReason::kMaxError || best_.stop == StopReason::kExact || max_error_of(best_) <= floor_;
    greedy_error_ = max_error_of(best_);
    return {};
  }

  Result<void> search() {
    if (has_room_) return fit_into_room();
    if (is_time_up()) return {};
    auto next = guess_by_refinement();
    if (!next) return tl::unexpected(next.error());
    for (double error = *next;; error = guess()) {
      if (auto looked = look(error); !looked) return looked;
      if (has_ended() || is_time_up()) return {};
    }
  }

  /// Then the best mesh so far is the result.
  bool is_time_up() {
    best_.is_cut_short = best_.is_cut_short || (options_.run.is_time_up && options_.run.is_time_up());
    return best_.is_cut_short;
  }

  /// Greedy insertion has reached the floor: effort makes that mesh smaller. Where rounding forbids the floor, the
  /// error that was reached will do.
  Result<void> fit_into_room() {
    if (auto looked = look(floor_); !looked || fits_ || greedy_error_ <= floor_) return looked;
    return look(greedy_error_);
  }

  bool has_ended() const {
    const double enough = std::log(runs_ < kFullPatience ? kFull : kNearlyFull);
    return runs_ == kMostRuns || is_at_floor_ || (fits_ && fits_->used >= enough) ||
           (exceeds_ && highest() - exceeds_->error < kClosed);
  }

  /// Refinement alone tells how triangles grow as the bound falls, and about what share of them effort leaves.
  Result<double> guess_by_refinement() {
    Sight last{highest(), expected_after(best_)};
    double step = (last.used - std::log(kAim)) / power_;
    for (int look = 0; look < 2 && std::abs(step) > 0.1; ++look) {
      const double error = last.error + step;
      if (is_near_floor(error)) return floor_;
      const auto used = expect_by_refinement(std::exp(error));
      if (!used) return tl::unexpected(used.error());
      const Sight here{error, *used};
      power_ = power_between(last, here);
      last = here;
      step = (last.used - std::log(kAim)) / power_;
    }
    const double error = std::min(last.error + step, highest());
    return is_near_floor(error) ? floor_ : std::exp(error);
  }

  Result<double> expect_by_refinement(double error) {
    SimplifyOptions refine = without_effort(towards(error));
    refine.output.normals = refine.output.uvs = false;
    const auto made = run(std::move(refine), 0.05);
    if (!made && made.error().kind == ErrorKind::kPromise) return std::log(kAim);
    if (!made) return tl::unexpected(made.error());
    add_work(*made, others_);
    return expected_after(*made);
  }

  /// What effort is expected to leave of a refined mesh: the more, the nearer its triangles come to the full grid's.
  /// Lines through what bench/quality/fit.cpp has measured.
  double expected_after(const Simplified& refined) const {
    const auto full = 2 * static_cast<double>(std::max<std::uint64_t>(refined.measurement.samples, 1));
    const double density = std::min(static_cast<double>(refined.mesh.triangle_count()) / full, 1.0);
    const bool is_free = options_.quality.vertices != Vertices::kSamples;
    double kept = is_free ? 0.26 + 0.35 * std::sqrt(density) : 0.33 + 0.4 * std::sqrt(density);
    if (options_.quality.effort == Effort::kNormal) kept = 0.52 + 0.2 * density;
    return std::log(kept * used_by(refined));
  }

  /// The logarithm of the least bound that is known to have a mesh within the budgets.
  double highest() const { return fits_ ? fits_->error : std::log(greedy_error_); }

  bool is_near_floor(double error) const {
    return error <= (floor_ > 0 ? std::log(floor_) + kNearFloor : std::log(greedy_error_ * kFarBelow));
  }

  /// The next bound: along the power that was seen last while all runs lie on one side of the budget, else between
  /// those that fit and those that do not.
  double guess() {
    const Sight& known = fits_ ? *fits_ : *exceeds_;
    double error = known.error + (known.used - std::log(kAim)) / power_;
    if (!exceeds_) {
      error = std::clamp(error, known.error - std::log(2.0), known.error - kClosed);
      return is_near_floor(error) ? floor_ : std::exp(error);
    }
    const double width = highest() - exceeds_->error;
    constexpr int kTrusted = 3;  // runs in vain: a power misleads where outlines alone nearly take the budget
    if (!std::isfinite(exceeds_->used) || (!fits_ && stays_ > kTrusted)) {
      error = highest() - width / 2;
    } else if (fits_) {
      error = cross_aim();
    }
    return std::exp(std::clamp(error, exceeds_->error + width / 20, highest() - width / 20));
  }

  /// Where the line between both sides meets the aim; by the Illinois rule an end that stays weighs less and less, so
  /// that steep counts, too, are closed in from both sides. REQUIRES: fits_, exceeds_, finite.
  double cross_aim() const {
    const double weight = std::pow(0.5, std::max(0, stays_ - 1));
    double below = fits_->used - std::log(kAim), above = exceeds_->used - std::log(kAim);
    (last_fits_ ? above : below) *= weight;
    if (below >= 0) return fits_->error;
    return (exceeds_->error * -below + fits_->error * above) / (above - below);
  }

  /// A run with the whole effort. Keeps the better mesh.
  Result<void> look(double error) {
    ++runs_;
    auto made = run(towards(error), 0.35);
    if (!made && made.error().kind != ErrorKind::kPromise) return tl::unexpected(made.error());
    const double used = made ? used_by(*made) : std::numeric_limits<double>::infinity();
    if (made && used > 1) add_work(*made, others_);
    if (used > 1) {
      see(exceeds_, Sight{error > 0 ? std::log(error) : std::log(greedy_error_ * kFarBelow), std::log(used)});
      return {};
    }
    is_at_floor_ = error == floor_;
    // A mesh is the same for all bounds down to its max error, or nearly so.
    const double reached = std::min(error, max_error_of(*made));
    see(fits_, Sight{std::log(std::max(reached, std::numeric_limits<double>::min())), std::log(used)});
    made->stop = has_room_ ? best_.stop : stop_of(*made);
    // Lines that follow the floor may need more than those of the error that was found to reach it.
    const bool is_larger = has_room_ && made->mesh.triangle_count() > best_.mesh.triangle_count();
    if (is_larger || (!is_at_floor_ && !is_better(*made))) {
      add_work(*made, others_);
      return {};
    }
    add_work(best_, others_);
    best_ = std::move(*made);
    return {};
  }

  /// Two runs on the same side of the budget tell the power, if they are not too near for that.
  void see(std::optional<Sight>& side, const Sight& here) {
    constexpr double kNear = 0.03;
    if (side && std::isfinite(side->used - here.used) && std::abs(side->error - here.error) > kNear)
      power_ = power_between(*side, here);
    side = here;
    const bool is_fit = &side == &fits_;
    stays_ = is_fit == last_fits_ ? stays_ + 1 : 1;
    last_fits_ = is_fit;
  }

  StopReason stop_of(const Simplified& made) const {
    if (is_at_floor_ || max_error_of(made) <= floor_)
      return options_.goals.max_error ? StopReason::kMaxError : StopReason::kExact;
    const MeshSize vertices{made.mesh.vertex_count(), 0}, triangles{0, made.mesh.triangle_count()};
    return budget_.used(vertices) > budget_.used(triangles) ? StopReason::kMaxVertices : StopReason::kMaxTriangles;
  }

  double max_error_of(const Simplified& made) const {
    if (judged_ == Judged::kWeighted) return made.weighted_max_error;
    return judged_ == Judged::kNorm ? made.combined_max_error : made.measurement.max_error;
  }
  double rmse_of(const Simplified& made) const {
    if (judged_ == Judged::kWeighted) return made.weighted_rmse;
    return judged_ == Judged::kNorm ? made.combined_rmse : made.measurement.rmse;
  }

  bool is_better(const Simplified& made) const {
    const auto rank = [this](const Simplified& of) {
      const double largest = max_error_of(of), rmse = rmse_of(of);
      return options_.goals.objective == Objective::kMax ? std::tuple(largest, rmse, of.mesh.triangle_count())
                                                         : std::tuple(rmse, largest, of.mesh.triangle_count());
    };
    return rank(made) < rank(best_);
  }

  Result<Simplified> run(SimplifyOptions options, double share) {
    if (!progress_.begin(share)) return fail(ErrorKind::kCancelled, "cancelled while searching an error");
    options.run.progress = progress_.of_run(options.quality.effort != Effort::kFast);
    constexpr std::uint64_t kBytesPerVertex = 48;
    options.run.memory.taken += kBytesPerVertex * best_.mesh.vertex_count();
    return run_(options);
  }

  static SimplifyOptions without_effort(SimplifyOptions options) {
    options.quality.effort = Effort::kFast;
    return options;
  }

  SimplifyOptions towards(double error) const {
    SimplifyOptions options = options_;
    options.goals.max_triangles = options.goals.max_vertices = std::nullopt;
    options.goals.max_error = error;
    options.goals.objective = Objective::kMax;  // of the search, not of a run
    return options;
  }

  double used_by(const Simplified& made) const {
    return budget_.used({made.mesh.vertex_count(), made.mesh.triangle_count()});
  }

  const SimplifyOptions& options_;
  const RunOnce& run_;
  Judged judged_;
  Budget budget_;
  SearchProgress progress_;
  double floor_;  // the least bound that is of use
  Simplified best_;
  double greedy_error_ = 0;
  bool has_room_ = false;
  int runs_ = 0, stays_ = 0;  // with the whole effort; of them the last, on one side of the budget
  bool last_fits_ = false;
  double power_ = kUsualPower;
  bool is_at_floor_ = false;
  std::optional<Sight> fits_, exceeds_;  // the least bound that fits, the largest that does not
  Pass others_{"search"};
};

}  // namespace

Result<Simplified> search_error(const SimplifyOptions& options, const RunOnce& run, Judged judged) {
  return ErrorSearch(options, run, judged).execute();
}

}  // namespace scarp
