#include "fit/square_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fit/insertion.h"
#include "fit/rounds.h"
#include "fit/schedule.h"

namespace scarp::fit {

namespace {

/// Share of the triangles that the first exchange removes, and the share below which exchanges end.
constexpr double kFirstExchange = 0.1, kLastExchange = 0.004;
/// Factor of the share from the third exchange on; after a failed exchange, the factor is kFailed.
constexpr double kSmaller = 0.8, kFailed = 0.5;
/// Factor to which Σ e² must fall for an exchange to be accepted.
constexpr double kWorthExchange = 0.9995;
/// Triangles relative to the wanted number after each round that reduces a mesh in patches.
constexpr double kReductions[] = {1.6, 1.15, 1};
constexpr int kSweepsAfterReduction = 3, kSweepsAfterExchange = 2, kLastSweeps = 6;
/// The most correction rounds that follow until the mesh is within the budget.
constexpr int kCorrections = 4;

double energy_of(const Patch& patch) {
  double sum = 0;
  for (Patch::Id f = 0; f < patch.face_count(); ++f) {
    if (patch.face(f).corners[0] != tin::kNone) sum += double{patch.face(f).energy};
  }
  return sum;
}

class SquareRounds {
 public:
  SquareRounds(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
               const FitOptions& options)
      : raster_(raster), options_(options), rounds_(raster, std::move(tin), std::move(lattice), options) {
    repair_ = rounds_.repair_options(0, 0);
    repair_.depth = {0, 1.5, false};
    repair_.depth.mends_all = true;
    repair_.is_time_up = {};
  }

  Result<Fitted> run() {
    if (!reduce_all() || !exchange_all() || !polish() || !correct())
      return fail(ErrorKind::kCancelled, "cancelled while lowering the squared error");
    return rounds_.finish();
  }

 private:
  struct Share {
    double energy = 0;
    std::size_t triangles = 0, target = 0;
  };

  bool reduce_all() {
    for (const double over : kReductions) {
      if (over > 1 && side() >= longest()) continue;
      if (!round(over, 0.5 * (over == 1 ? 1 : 1 / over), [this](Patch& patch, const TriangleError& error, Share of) {
            reduce_from_start(patch, error, of.target);
            sweep(patch, error, options_of(patch), kSweepsAfterReduction);
          }))
        return false;
    }
    return true;
  }

  bool exchange_all() {
    double share = kFirstExchange, before = energy_;
    for (int i = 0; i < options_.squares->exchanges && share > kLastExchange && !rounds_.is_time_up(); ++i) {
      const double end = 0.5 + 0.4 * (i + 1) / options_.squares->exchanges;
      const auto exchange = [this, share](Patch& patch, const TriangleError& error, Share of) {
        this->exchange(patch, error, of, share);
      };
      if (!round(1, end, exchange)) return false;
      // The energy after a round is known in the next round.
      if (i > 0) share *= energy_ < kWorthExchange * before ? (i > 2 ? kSmaller : 1) : kFailed;
      before = energy_;
    }
    return true;
  }

  bool polish() {
    const bool is_cut = side() < longest();
    for (int left = kLastSweeps; left > 0; left -= is_cut ? 2 : kLastSweeps) {
      if (!round(1, 0.97, [&](Patch& patch, const TriangleError& error, Share) {
            sweep(patch, error, options_of(patch), is_cut ? 2 : kLastSweeps);
          }))
        return false;
    }
    return true;
  }

  /// Meets the budget, even if the squared error rises.
  bool correct() {
    for (int i = 0; i < kCorrections; ++i) {
      excess_ = 0;
      const auto reduce_only = [this](Patch& patch, const TriangleError& error, Share of) {
        if (of.triangles > of.target) reduce(patch, error, options_of(patch), of.target);
      };
      if (!needs_less()) return true;
      if (!round(1, 1, reduce_only)) return false;
    }
    return true;
  }

  bool needs_less() const {
    return triangles_ > options_.squares->most_triangles ||
           rounds_.tin().vertex_count() > options_.squares->most_vertices;
  }

  using Work = FunctionRef<void(Patch& patch, const TriangleError& error, Share share)>;

  /// `over`: wanted triangles relative to the budget.
  bool round(double over, double end, Work work) {
    const std::int32_t now = side();
    const PatchGrid grid{now, now < longest() && count_++ % 2 == 1 ? now / 2 : 0};
    std::vector<Share> shares;
    const bool goes_on = rounds_.work_twice(
        grid, end,
        [this](Patch& patch, const TriangleError& error) {
          Schedule(patch, error, ErrorRule::Power::kTwo, repair_).measure_all();
        },
        [&](std::span<const Patch> patches) { shares = allot(patches, over); },
        [&](std::size_t i, Patch& patch, const TriangleError& error) {
          if (error.has_energy()) work(patch, error.with({1, ErrorRule::Power::kTwo}), shares[i]);
        });
    triangles_ = rounds_.triangles();
    return goes_on;
  }

  /// The wanted number of triangles of each patch.
  std::vector<Share> allot(std::span<const Patch> patches, double over) {
    std::vector<Share> shares(patches.size());
    energy_ = 0;
    std::size_t all = 0;
    double weights = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      shares[i].energy = energy_of(patches[i]);
      shares[i].triangles = shares[i].target = patches[i].count_faces();
      energy_ += shares[i].energy;
      all += shares[i].triangles;
      weights += weight_of(shares[i]);
    }
    const double wanted = over * static_cast<double>(wanted_triangles(all));
    if (!(weights > 0)) return shares;
    // Vertices that could not be removed last time will remain this time.
    if (last_wanted_ > 0) excess_ = std::max(0.0, excess_ + static_cast<double>(all) - last_wanted_);
    last_wanted_ = wanted;
    double carried = 0;
    for (Share& share : shares) {
      const double exact = std::max(0.0, wanted - excess_) * weight_of(share) / weights + carried;
      share.target = static_cast<std::size_t>(std::max(1.0, std::floor(exact)));
      carried = exact - static_cast<double>(share.target);
    }
    return shares;
  }
  static double weight_of(const Share& share) {
    const auto n = static_cast<double>(share.triangles);
    return std::cbrt(share.energy * n * n);
  }

  /// Each vertex adds two triangles, except on the sides.
  std::uint64_t wanted_triangles(std::size_t all) const {
    const SquareGoal& goal = *options_.squares;
    std::uint64_t wanted = goal.most_triangles;
    const std::uint64_t vertices = rounds_.tin().vertex_count();
    if (goal.most_vertices == kNoBudget) return wanted;
    const auto left = static_cast<std::int64_t>(all) +
                      2 * (static_cast<std::int64_t>(goal.most_vertices) - static_cast<std::int64_t>(vertices));
    return std::min<std::uint64_t>(wanted, static_cast<std::uint64_t>(std::max<std::int64_t>(left, 1)));
  }

  RepairOptions options_of(const Patch& patch) const {
    RepairOptions of = repair_;
    of.rules = rounds_.rules_of(patch);
    return of;
  }
  /// A reduction without the floor shows whether the floor of shapes yields.
  void reduce_from_start(Patch& patch, const TriangleError& error, std::size_t most) const {
    if (!options_.floor_yields) return reduce(patch, error, options_of(patch), most);
    const Patch start = patch;
    RepairOptions free = options_of(patch);
    free.rules.shape.floor = 0;
    reduce(patch, error, free, most);
    const RepairOptions options = options_of(patch);
    if (options.rules.shape.floor == 0) return;
    patch = start;
    reduce(patch, error, options, most);
  }
  static void reduce(Patch& patch, const TriangleError& error, const RepairOptions& options, std::size_t most) {
    Schedule(patch, error, ErrorRule::Power::kTwo, options).remove_all(most);
  }
  static void sweep(Patch& patch, const TriangleError& error, const RepairOptions& options, int times) {
    Schedule schedule(patch, error, ErrorRule::Power::kTwo, options);
    for (int i = 0; i < times; ++i) schedule.sweep();
  }

  static void insert(Patch& patch, const TriangleError& error, const RepairOptions& options, std::size_t most) {
    Repair repair(patch, error, options.depth, options.rules);
    Insertion(patch, error, options.rules, repair).run(most);
  }

  void exchange(Patch& patch, const TriangleError& error, const Share& of, double share) const {
    const Patch before = patch;
    const RepairOptions options = options_of(patch);
    const auto target = static_cast<double>(of.target), had = static_cast<double>(of.triangles);
    reduce(patch, error, options,
           of.target - std::min(of.target, static_cast<std::size_t>(std::max(2.0, share * target))));
    insert(patch, error, options, of.target);
    sweep(patch, error, options, kSweepsAfterExchange);
    // Σ e² is expected to change when triangles move between patches.
    const double scale = had / target;
    if (energy_of(patch) < kWorthExchange * of.energy * scale * scale) return;
    patch = before;
    if (of.triangles > of.target) reduce(patch, error, options, of.target);
    if (of.triangles < of.target) insert(patch, error, options, of.target);
  }

  std::int32_t longest() const { return std::max(raster_.cols, raster_.rows); }

  /// Side of squares with some kPatchTriangles triangles of the budget; on a narrow raster, length of pieces.
  std::int32_t side() const {
    const std::uint64_t wanted = wanted_triangles(rounds_.tin().triangle_count());
    const std::int32_t most = options_.most_side > 0 ? std::min(options_.most_side, longest()) : longest();
    if (options_.patch_side > 0) return std::min(most, options_.patch_side);
    if (wanted <= 2 * kPatchTriangles) return most;
    const double cols = raster_.cols, rows = raster_.rows;
    const double area = cols * rows * kPatchTriangles / static_cast<double>(wanted);
    return std::clamp(static_cast<std::int32_t>(std::max(std::sqrt(area), area / std::min(cols, rows))), 2, most);
  }

  const grid::Raster& raster_;
  const FitOptions& options_;
  Rounds rounds_;
  RepairOptions repair_;
  int count_ = 0;  // number of rounds
  double energy_ = 0, excess_ = 0, last_wanted_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

Result<Fitted> fit_squares(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
                           const FitOptions& options) {
  return SquareRounds(raster, std::move(tin), std::move(lattice), options).run();
}

}  // namespace scarp::fit
