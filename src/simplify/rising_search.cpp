#include "simplify/rising_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "metric/criterion.h"
#include "pieces/budget.h"
#include "simplify/pass_work.h"
#include "simplify/search_progress.h"

namespace scarp::run {

namespace {

constexpr double kAim = 1.12;       // share of the budget where the bound begins to rise
constexpr double kAimAgain = 1.06;  // the same once a run has shown the share
constexpr double kRise = 1.5;       // the bound in a run rises at most by this factor

/// Refined triangles relative to the budget. If there are fewer, fast effort might be better than the search.
constexpr double kLeastRefined = 1.5;
constexpr double kFarRise = 1.15;  // if the error is larger than the counted one by more, triangles are counted again

/// Triangles that remain after repair, relative to those after removal: with free vertices, and on samples.
constexpr double kRepairedFree = 0.53, kRepairedOnSamples = 0.67;

/// Finds the error for which the whole effort is expected to use kAim of the budget.
class RisingSearch {
 public:
  RisingSearch(const SimplifyOptions& options, const BudgetTask& task)
      : options_(options), task_(task), number_(options), budget_(options), progress_(options.run.progress) {}

  Result<Simplified> execute() {
    const auto start = Clock::now();
    SCARP_TRY(double number, descend());
    for (int i = 0; i < kMostRises && number > 0 && !is_time_up(); ++i) {
      auto made = run(number_.towards(kRise * number), {.start = 1 / kRise, .room = budget_}, 0.6);
      if (!made) return made;
      const pieces::MeshSize size{made->mesh.vertex_count(), made->mesh.triangle_count()};
      const double used = budget_.used(size);
      if (used <= 1 && used >= kNearlyFull) {
        if (made->judged_max_error > kFarRise * counted_) {
          SCARP_TRY(const double refined, look(number_.towards(made->judged_max_error), true));
          if (refined < kLeastRefined / kFarRise) break;
        }
        made->stop = budget_.tighter(size);
        others_.seconds = seconds_since(start) - made->seconds_refine - made->seconds_measure;
        made->seconds_refine += others_.seconds;
        made->passes.insert(made->passes.begin(), others_);
        return made;
      }
      add_work(*made, others_);
      number *= used > 1 ? kRise : std::pow(used / kAimAgain, 1 / power_);
      if (is_beyond(number)) break;
    }
    return fail(ErrorKind::kPromise, "");
  }

 private:
  /// 0 if there is none.
  Result<double> descend() {
    constexpr double kFarthest = 8, kNear = 0.1;
    constexpr int kMostLooks = 8;
    highest_ = task_.most() / 4;
    lowest_ = std::max(options_.goals.max_error.value_or(0), 0x1p-40 * highest_);
    double number = std::min(first_guess(), highest_);
    std::optional<std::pair<double, double>> last;
    for (int i = 0; i < kMostLooks && number > lowest_; ++i) {
      SCARP_TRY(const double refined, look(number_.towards(number), true));
      counted_ = number;
      const double here = std::log(number),
                   used = std::log(expected_share(options_, task_.traits, triangles_, task_.samples) * refined);
      if (last && last->first != here) power_ = std::clamp((used - last->second) / (last->first - here), 0.3, 20.0);
      last.emplace(here, used);
      const double step = (used - std::log(kAim)) / power_;
      if (number == highest_ && step > 0) return 0.0;
      number = std::min(number * std::exp(std::clamp(step, -std::log(kFarthest), std::log(kFarthest))), highest_);
      if (is_beyond(number)) return 0.0;
      if (std::abs(step) > kNear) continue;
      if (refined < kLeastRefined) return 0.0;
      return task_.traits.depth.rounds > 0 ? correct_by_removal(number) : number;
    }
    return 0.0;
  }

  bool is_time_up() const { return options_.run.is_time_up && options_.run.is_time_up(); }
  bool is_beyond(double number) const { return number > highest_ || number <= lowest_; }

  /// Natural land needs some 3 % of the triangles of all samples for 0.8 % of its relief. At first, too few triangles
  /// cost less time than too many.
  double first_guess() const {
    constexpr double kFew = 4;
    const pieces::MeshSize most = budget_.most();
    const double triangles = std::min(static_cast<double>(most.triangles), 2 * static_cast<double>(most.vertices));
    const double relief = task_.most() / 2, density = triangles / (2 * static_cast<double>(task_.samples));
    const double refined =
        density / expected_share(options_, task_.traits, static_cast<std::uint64_t>(triangles), task_.samples);
    return kFew * 0.008 * relief * std::pow(0.03 / refined, 1 / power_);
  }

  /// After removal, the number of triangles depends less on the land than after refinement.
  Result<double> correct_by_removal(double number) {
    SimplifyOptions options = number_.towards(number);
    options.quality.effort = Effort::kNormal;
    options.quality.vertices = Vertices::kAuto;
    options.quality.min_shape = std::nullopt;
    SCARP_TRY(const double removed, look(std::move(options), false));
    const bool is_free = options_.quality.vertices != Vertices::kSamples;
    const double used = (is_free ? kRepairedFree : kRepairedOnSamples) * removed;
    const double corrected = number * std::pow(used / kAim, 1 / power_);
    return is_beyond(corrected) ? 0.0 : corrected;
  }

  /// The share of the budget that a run uses of which only the size matters; sets triangles_.
  Result<double> look(SimplifyOptions options, bool refines_only) {
    options.output.normals = options.output.uvs = false;
    auto made = run(std::move(options), {.room = pieces::Budget(0, 0), .refines_only = refines_only}, 0.1);
    if (!made) return tl::unexpected(made.error());
    add_work(*made, others_);
    triangles_ = made->mesh.triangle_count();
    return budget_.used({made->mesh.vertex_count(), triangles_});
  }

  Result<Simplified> run(SimplifyOptions options, const pieces::Scale& scale, double share) {
    if (!progress_.begin(share))
      return fail(ErrorKind::kCancelled, "cancelled while searching for the mesh of a budget");
    options.run.progress = progress_.of_run(!scale.refines_only);
    return task_.run(options, scale);
  }

  const SimplifyOptions& options_;
  const BudgetTask& task_;
  BudgetNumber number_;
  pieces::Budget budget_;
  SearchProgress progress_;
  double highest_ = 0, lowest_ = 0;  // limits of useful errors
  double counted_ = 0;               // the last error whose refined triangles were counted
  double power_ = 1.6;               // triangles ~ error^-power
  std::uint64_t triangles_ = 0;      // number in the last run whose size alone matters
  Pass others_{"search"};
};

}  // namespace

bool may_rise(const SimplifyOptions& options, const BudgetTask& task) {
  return task.traits.fits && task.raises_bound && options.goals.objective == Objective::kMax &&
         !metric::has_tolerances(options) && !(task.traits.goes_on && options.run.is_time_up);
}

Result<Simplified> search_by_rising(const SimplifyOptions& options, const BudgetTask& task) {
  return RisingSearch(options, task).execute();
}

double expected_share(const SimplifyOptions& options, const pieces::EffortTraits& traits, std::uint64_t refined,
                      std::uint64_t samples) {
  const auto full = 2 * static_cast<double>(std::max<std::uint64_t>(samples, 1));
  const double density = std::min(static_cast<double>(refined) / full, 1.0);
  if (!traits.moves_vertices) return 0.52 + 0.2 * density;
  return options.quality.vertices != Vertices::kSamples ? 0.26 + 0.35 * std::sqrt(density)
                                                        : 0.33 + 0.4 * std::sqrt(density);
}

}  // namespace scarp::run
