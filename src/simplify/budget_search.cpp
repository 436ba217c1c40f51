#include "simplify/budget_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "base/clock.h"
#include "metric/criterion.h"
#include "pieces/budget.h"
#include "simplify/pass_work.h"
#include "simplify/rising_search.h"
#include "simplify/search_progress.h"

namespace scarp::run {

namespace {

constexpr double kFull = 0.99;       // used share that ends the search
constexpr double kNearFloor = 0.02;  // logarithm; a number that is this near to a goal is replaced by the goal
constexpr double kLeast = std::numeric_limits<double>::min();

/// Below this number, the triangles scatter from run to run by more than a percent. If their number jumps, the mesh of
/// a smaller budget may be better.
constexpr std::size_t kFewTriangles = 500;
constexpr double kJump = 0.9;  // after a jump, less than this share of the budget is used

/// How a search continues from its start.
struct Pace {
  double power;      ///< triangles ~ number^-power, before runs determine it
  double farthest;   ///< step, as a ratio, while all meshes fit
  double far_below;  ///< ratio to the first mesh's number: below it an exact mesh is likely to fit
  double near;       ///< logarithm: nearer runs do not determine the power
  double aim;        ///< share of the budget: below 1 by about the scatter of a run
  double closed;     ///< logarithm: nearer numbers on both sides of the budget end the search
  int patience;      ///< runs before kNearlyFull suffices
  int most_runs;
};
constexpr Pace kFromInsertion{1.3, 2, 1.0 / 64, 0.03, 0.995, 0.002, 4, kMostRuns};
constexpr Pace kFromFew{1.3, 2, 1.0 / 64, 0.03, 0.99, 0.005, 2, kMostRuns};
constexpr Pace kFromLeastMesh{1, 32, 0x1p-20, 0.02, 0.995, 0.002, 5, kMostRunsFromLeast};

/// The logarithms of a number and of the share of the budget that its mesh uses.
struct Sight {
  double number = 0, used = 0;
};

/// Minus the slope of the line through both points, within a plausible range.
double power_between(const Sight& a, const Sight& b, double usual) {
  const double run = a.number - b.number;
  return run == 0 ? usual : std::clamp((b.used - a.used) / run, 0.3, 20.0);
}

}  // namespace

BudgetNumber::BudgetNumber(const SimplifyOptions& options)
    : options_(options), is_factor_(metric::has_tolerances(options)) {}

SimplifyOptions BudgetNumber::towards(double number) const {
  SimplifyOptions options = options_;
  std::optional<double>& max_error = options.goals.max_error;
  options.goals.max_triangles = options.goals.max_vertices = std::nullopt;
  if (!is_factor_) max_error = number;
  if (is_factor_ && max_error) max_error = std::min(number * *max_error, std::numeric_limits<double>::max());
  options.goals.objective = Objective::kMax;  // the search's objective, not a run's
  return options;
}

namespace {

/// A key that is smaller for a better mesh.
std::tuple<double, double, std::size_t> rank(const SimplifyOptions& options, const Simplified& of) {
  const double largest = of.judged_max_error, rmse = of.judged_rmse;
  return options.goals.objective == Objective::kMax ? std::tuple(largest, rmse, of.mesh.triangle_count())
                                                    : std::tuple(rmse, largest, of.mesh.triangle_count());
}

/// Halves the budgets and reports full progress.
SimplifyOptions with_half_a_budget(SimplifyOptions options) {
  for (std::optional<std::uint64_t>* budget : {&options.goals.max_triangles, &options.goals.max_vertices}) {
    if (*budget) **budget = std::max<std::uint64_t>(**budget / 2, 1);
  }
  if (const ProgressCallback told = options.run.progress) {
    options.run.progress = [told](Progress progress) {
      progress.fraction = 1;
      return told(progress);
    };
  }
  return options;
}

class BudgetSearch {
 public:
  BudgetSearch(const SimplifyOptions& options, const BudgetTask& task, bool refines_only)
      : options_(options),
        task_(task),
        budget_(options),
        progress_(options.run.progress),
        has_effort_(task.traits.fits && !refines_only),
        number_(options),
        is_factor_(number_.is_factor()),
        floor_(is_factor_ ? 1 : options.goals.max_error.value_or(0)),
        pace_(has_effort_ ? kFromInsertion : kFromLeastMesh),
        power_(pace_.power) {}

  Result<Simplified> execute() {
    const auto start = Clock::now();
    SCARP_RETURN_IF_ERROR(has_effort_ ? begin_without_effort() : begin_with_least_mesh());
    SCARP_RETURN_IF_ERROR(search());
    // A search may have found the first mesh, too.
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

  /// The error for meshes that are within the budget but did not fit in memory.
  const std::optional<Error>& no_room() const { return no_room_; }

  /// True if the number of triangles jumps over the budget, so that much of it is unused.
  bool has_jumped() const {
    return fits_ && exceeds_ && highest() - exceeds_->number < pace_.closed && fits_->used < std::log(kJump);
  }

 private:
  /// This run refuses a budget that is too small.
  Result<void> begin_without_effort() {
    SimplifyOptions fast = options_;
    fast.goals.objective = Objective::kMax;  // the search's objective, not a run's
    Result<Simplified> made;
    if (task_.insertion_stops) {
      made = run(fast, {.refines_only = true}, 0.1);
    } else {
      if (!progress_.begin(0.1)) return fail(ErrorKind::kCancelled, kCancelled);
      fast.run.progress = progress_.of_run(false);
      BudgetSearch search(fast, task_, true);
      made = search.execute();
      no_room_ = search.no_room();
      has_mesh_ = made.has_value();
    }
    SCARP_RETURN_IF_ERROR(made);
    best_ = std::move(*made);
    first_ = best_.judged_max_error;
    if (best_.mesh.triangle_count() < kFewTriangles) pace_ = kFromFew;
    has_room_ = best_.stop == StopReason::kMaxError || best_.stop == StopReason::kExact || first_ <= floor_;
    // No factor helps a sample whose tolerance is 0, so the search starts at the least mesh.
    if (std::isinf(first_)) pace_ = kFromLeastMesh, power_ = pace_.power;
    far_below_ = std::log(first_ * pace_.far_below);
    return {};
  }

  Result<void> begin_with_least_mesh() {
    const double most = std::max(task_.most(), floor_);
    SCARP_TRY(auto&& least, run(number_.towards(most), {.factor = number_.factor_of(most), .refines_only = true}, 0.1));
    const pieces::MeshSize size{least.mesh.vertex_count(), least.mesh.triangle_count()};
    SCARP_RETURN_IF_ERROR(budget_.check(size, task_.least, ""));
    best_ = std::move(least);
    first_ = std::max(best_.judged_max_error, kLeast);
    is_at_floor_ = best_.judged_max_error <= floor_;
    end_by(best_);
    fits_ = Sight{std::log(first_), std::log(used_by(best_))};
    far_below_ = std::log(first_ * pace_.far_below);
    return {};
  }

  Result<void> search() {
    if (has_room_) return fit_into_room();
    if (has_effort_) {
      if (is_time_up()) return {};
      SCARP_TRY(const auto& first, std::isinf(first_) ? Result<double>(task_.most()) : guess_by_refinement());
      SCARP_RETURN_IF_ERROR(look(first));
    }
    while (!has_ended() && !is_time_up()) {
      SCARP_RETURN_IF_ERROR(look(guess()));
    }
    return {};
  }

  /// True if the best mesh so far is to be the result.
  bool is_time_up() {
    if (!has_effort_) return false;
    best_.is_cut_short = best_.is_cut_short || (options_.run.is_time_up && options_.run.is_time_up());
    return best_.is_cut_short;
  }

  /// Fast effort has reached the floor, and a larger effort makes that mesh smaller. If rounding prevents the floor,
  /// the reached number is used.
  Result<void> fit_into_room() {
    if (auto looked = look(floor_); !looked || fits_ || first_ <= floor_) return looked;
    return look(first_);
  }

  bool has_ended() const {
    const double enough = std::log(runs_ < pace_.patience ? kFull : kNearlyFull);
    return runs_ == pace_.most_runs || is_at_floor_ || (fits_ && fits_->used >= enough) ||
           (!fits_ && std::isinf(first_)) || (exceeds_ && highest() - exceeds_->number < closed());
  }

  /// Triangles that scatter, but do not jump, may use more of the budget between nearer numbers.
  double closed() const {
    const bool scatters = fits_ && fits_->used < std::log(kNearlyFull) && fits_->used >= std::log(kJump);
    return scatters ? pace_.closed / 8 : pace_.closed;
  }

  /// Finds by refinement how the number of triangles grows as the bounds fall.
  Result<double> guess_by_refinement() {
    Sight last{highest(), expected_after(best_)};
    double step = (last.used - std::log(pace_.aim)) / power_;
    for (int look = 0; look < 2 && std::abs(step) > 0.1; ++look) {
      const double number = last.number + step;
      if (is_near_floor(number)) return floor_;
      SCARP_TRY(const auto& used, expect_by_refinement(std::exp(number)));
      const Sight here{number, used};
      power_ = power_between(last, here, pace_.power);
      last = here;
      step = (last.used - std::log(pace_.aim)) / power_;
    }
    const double number = std::min(last.number + step, highest());
    return is_near_floor(number) ? floor_ : std::exp(number);
  }

  Result<double> expect_by_refinement(double number) {
    SimplifyOptions refine = number_.towards(number);
    refine.output.normals = refine.output.uvs = false;
    const pieces::Scale scale{.factor = number_.factor_of(number), .room = pieces::Budget(0, 0), .refines_only = true};
    const auto made = run(std::move(refine), scale, 0.05);
    if (!made && made.error().kind == ErrorKind::kPromise) return std::log(pace_.aim);
    SCARP_RETURN_IF_ERROR(made);
    add_work(*made, others_);
    return expected_after(*made);
  }

  /// The logarithm of the share of the budget that the whole effort is expected to use.
  double expected_after(const Simplified& refined) const {
    return std::log(expected_share(options_, task_.traits, refined.mesh.triangle_count(), best_.measurement.samples) *
                    used_by(refined));
  }

  /// The logarithm of the least number that is known to have a mesh within the budgets.
  double highest() const { return fits_ ? fits_->number : std::log(first_); }

  bool is_near_floor(double number) const {
    return number <= (floor_ > 0 ? std::log(floor_) + kNearFloor : far_below_);
  }

  /// The next number: by the last power if all runs are on one side of the budget, else between runs that fit and runs
  /// that do not.
  double guess() const {
    const Sight& known = fits_ ? *fits_ : *exceeds_;
    double number = known.number + (known.used - std::log(pace_.aim)) / power_;
    if (!exceeds_) {
      number = std::clamp(number, known.number - std::log(pace_.farthest), known.number - pace_.closed);
      return is_near_floor(number) ? floor_ : std::exp(number);
    }
    const double width = highest() - exceeds_->number;
    constexpr int kTrusted = 3;  // vain runs; a power is misleading if outlines nearly use up the budget
    if (!std::isfinite(exceeds_->used) || (!fits_ && stays_ > kTrusted)) {
      number = highest() - width / 2;
    } else if (fits_) {
      number = cross_aim();
    }
    return std::exp(std::clamp(number, exceeds_->number + width / 20, highest() - width / 20));
  }

  /// The point where the line between both sides meets the aim. By the Illinois rule, an end that stays weighs less and
  /// less, so that both sides approach the aim even for steep counts. REQUIRES: fits_, exceeds_, finite.
  double cross_aim() const {
    const double weight = std::pow(0.5, std::max(0, stays_ - 1));
    double below = fits_->used - std::log(pace_.aim), above = exceeds_->used - std::log(pace_.aim);
    (last_fits_ ? above : below) *= weight;
    if (below >= 0) return fits_->number;
    return (exceeds_->number * -below + fits_->number * above) / (above - below);
  }

  /// Makes a run with the whole effort and keeps the better mesh.
  Result<void> look(double number) {
    ++runs_;
    const pieces::Scale scale{.factor = number_.factor_of(number), .room = budget_, .refines_only = !has_effort_};
    auto made = run(number_.towards(number), scale, 0.35);
    if (!made && made.error().kind != ErrorKind::kPromise) return tl::unexpected(made.error());
    const double used = made ? used_by(*made) : std::numeric_limits<double>::infinity();
    if (made && used > 1) add_work(*made, others_);
    if (used > 1) {
      const double nothing = has_effort_ ? far_below_ : highest() + std::log(pace_.far_below);
      see(exceeds_, Sight{number > 0 ? std::log(number) : nothing, std::log(used)});
      return {};
    }
    // The mesh is nearly the same for all numbers down to the one that it reaches.
    const double reached = std::min(number, made->judged_max_error);
    // A larger effort may find a smaller mesh for the floor itself.
    is_at_floor_ = number == floor_ || (!has_effort_ && reached <= floor_);
    see(fits_, Sight{std::log(std::max(reached, kLeast)), std::log(used)});
    end_by(*made);
    // Lines at the floor may need more vertices than lines at the number that reached it. If the floor is only a cap, a
    // mesh of fewer triangles may have a larger squared error.
    const bool is_worse = has_room_ && (options_.goals.objective == Objective::kMax
                                            ? made->mesh.triangle_count() > best_.mesh.triangle_count()
                                            : !is_better(*made));
    if (is_worse || (!is_at_floor_ && !is_better(*made))) {
      add_work(*made, others_);
      return {};
    }
    add_work(best_, others_);
    best_ = std::move(*made);
    return {};
  }

  /// Two runs on the same side of the budget determine the power, unless they are too near.
  void see(std::optional<Sight>& side, const Sight& here) {
    if (side && std::isfinite(side->used - here.used) && std::abs(side->number - here.number) > pace_.near)
      power_ = power_between(*side, here, pace_.power);
    side = here;
    const bool is_fit = &side == &fits_;
    stays_ = is_fit == last_fits_ ? stays_ + 1 : 1;
    last_fits_ = is_fit;
  }

  void end_by(Simplified& made) const {
    made.stop = has_room_ ? best_.stop : stop_of(made);
    if (is_factor_ && made.stop == StopReason::kMaxError) made.tolerance_factor = 1;
  }

  StopReason stop_of(const Simplified& made) const {
    if (is_at_floor_ || made.judged_max_error <= floor_)
      return is_factor_ || options_.goals.max_error ? StopReason::kMaxError : StopReason::kExact;
    return budget_.tighter({made.mesh.vertex_count(), made.mesh.triangle_count()});
  }

  bool is_better(const Simplified& made) const { return rank(options_, made) < rank(options_, best_); }

  Result<Simplified> run(SimplifyOptions options, const pieces::Scale& scale, double share) {
    if (!progress_.begin(share)) return fail(ErrorKind::kCancelled, kCancelled);
    options.run.progress = progress_.of_run(!scale.refines_only);
    options.run.memory.taken += kMeshBytesPerVertex * best_.mesh.vertex_count();
    auto made = task_.run(options, scale);
    if (!made && has_mesh_ && !task_.insertion_stops) excuse(made.error());
    has_mesh_ = has_mesh_ || made.has_value();
    return made;
  }

  /// A run that fails only for some numbers ends the search below its number.
  void excuse(Error& error) {
    // Slivers of a cutline may vanish at one number and not at another.
    if (error.kind == ErrorKind::kInput) error.kind = ErrorKind::kPromise;
    // A mesh that needs too much memory may also exceed the budget.
    if (error.kind == ErrorKind::kUsage || error.kind == ErrorKind::kMemory) {
      no_room_ = error;
      error.kind = ErrorKind::kPromise;
    }
  }

  double used_by(const Simplified& made) const {
    return budget_.used({made.mesh.vertex_count(), made.mesh.triangle_count()});
  }

  static constexpr const char* kCancelled = "cancelled while searching for the mesh of a budget";

  const SimplifyOptions& options_;
  const BudgetTask& task_;
  pieces::Budget budget_;
  SearchProgress progress_;
  bool has_effort_;
  BudgetNumber number_;
  bool is_factor_;
  double floor_;  // the least useful number
  Pace pace_;
  double power_;
  Simplified best_;
  double first_ = 0;          // error of the first mesh
  double far_below_ = 0;      // a logarithm
  bool has_room_ = false;     // the first mesh is at the floor
  int runs_ = 0, stays_ = 0;  // runs after the first mesh; the last ones on one side of the budget
  bool last_fits_ = false, is_at_floor_ = false;
  std::optional<Sight> fits_, exceeds_;  // the least number that fits, and the largest that does not
  bool has_mesh_ = false;
  std::optional<Error> no_room_;
  Pass others_{"search"};
};

}  // namespace

Result<Simplified> search_budget(const SimplifyOptions& options, const BudgetTask& task, bool refines_only) {
  if (!refines_only && may_rise(options, task)) {
    auto made = search_by_rising(options, task);
    if (made || made.error().kind != ErrorKind::kPromise) return made;
  }
  BudgetSearch search(options, task, refines_only);
  auto made = search.execute();
  if (made && search.has_jumped() && !made->is_cut_short && made->mesh.triangle_count() < kFewTriangles) {
    auto smaller = search_budget(with_half_a_budget(options), task, refines_only);
    if (!smaller && smaller.error().kind == ErrorKind::kCancelled) return smaller;
    if (smaller && rank(options, *smaller) < rank(options, *made)) return smaller;
  }
  if (!made || !search.no_room() || made->stop == StopReason::kMaxError || made->stop == StopReason::kExact)
    return made;
  const double used = pieces::Budget(options).used({made->mesh.vertex_count(), made->mesh.triangle_count()});
  if (used < kNearlyFull) return tl::unexpected(*search.no_room());
  return made;
}

}  // namespace scarp::run
