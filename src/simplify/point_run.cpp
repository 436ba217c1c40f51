#include "simplify/point_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/reporter.h"
#include "grid/far_points.h"
#include "measure/point_judge.h"
#include "mesh/thin_triangles.h"
#include "pieces/budget.h"
#include "shape/shape_refinement.h"
#include "simplify/point_fit.h"

namespace scarp::run {

namespace {

/// One run of the engine towards the goals.
class PointRun {
 public:
  PointRun(const PointTask& task, const PointRecipe& recipe, refine::ScatteredDomain domain)
      : points_(task.points),
        snapped_(task.snapped),
        heights_(task.heights),
        recipe_(recipe),
        options_(recipe.options),
        lines_(task.lines),
        wider_(task.proof),
        budget_(options_.max_triangles, options_.max_vertices),
        bound_(options_.max_error.value_or(0)),
        least_(task.least(recipe.options)),
        width_(task.width),
        fits_(recipe.removes && recipe.aims.is_open()),
        // Vertices for shapes may be a step from an edge that rounding moves by half a step.
        is_on_lattice_(task.steps == grid::PointSteps::kFloat32 || (goals().any() && !snapped_.is_exact)),
        domain_(std::move(domain)),
        seeds_(domain_.point_of.size()),
        reporter_(options_.run.progress) {
    for (const double z : snapped_.z) largest_height_ = std::max(largest_height_, std::abs(z));
    if (options_.tolerances.empty()) return;
    for (const std::uint32_t source : snapped_.source) bounds_.push_back(recipe_.bound_of(source));
    aims_ = bounds_;
    for (double& aim : aims_) aim = recipe_.scale.start * std::max(0.0, PointAims(aim, recipe_.largest).refinement);
  }

  Result<Simplified> execute(Clock::time_point start) {
    start_refinement();
    SCARP_RETURN_IF_ERROR(budget_.check(size(), least_, ""));
    Simplified result;
    SCARP_RETURN_IF_ERROR(refine(result.stop));
    SCARP_RETURN_IF_ERROR(settle_lines(result.stop));
    result.passes.push_back({"refine", seconds_since(start), scanned_ + refinement_->points_scanned(),
                             dealt_ + refinement_->lists_dealt(), insertions_});
    take_best_prefix();
    if (recipe_.removes_last) {
      SCARP_RETURN_IF_ERROR(shape(recipe_.aims.refinement, result));
    }
    SCARP_RETURN_IF_ERROR(fit(result));
    if (!recipe_.removes_last) {
      SCARP_RETURN_IF_ERROR(shape(bound_, result));
    }
    freeze_into(result);
    result.seconds_refine = seconds_since(start);
    SCARP_RETURN_IF_ERROR(prove(result));
    return result;
  }

  const PointFacts& facts() const { return facts_; }

 private:
  pieces::MeshSize size() const { return {domain_.vertex_count(), refinement_->triangle_count()}; }
  std::optional<StopReason> exceeded(std::uint32_t gain) const { return budget_.exceeded(size(), gain); }

  /// Starts towards the bound that fitting needs, or the bound itself.
  void start_refinement() {
    if (!fits_) return restart_refinement();
    refinement_.emplace(snapped_, heights_, domain_, recipe_.scale.start * recipe_.aims.refinement, aims_);
  }
  /// Restarts towards the bound itself.
  void restart_refinement() { refinement_.emplace(snapped_, heights_, domain_, bound_, bounds_); }

  /// Reduces the mesh. Afterwards the workbench of refinement is rebuilt for the bound itself.
  Result<void> fit(Simplified& result) {
    result.effort = Effort::kFast;
    if (!fits_ || result.stop != StopReason::kMaxError) return {};
    forget_refinement();
    const auto start = Clock::now();
    SCARP_TRY(const auto& fitted, fit_points(snapped_, heights_, fixed_points(), recipe_, domain_));
    result.passes.push_back({.name = "fit", .seconds = seconds_since(start), .removals = fitted.removed});
    result.effort = recipe_.effort;
    if (!lines_.empty() && !goals().any()) {
      restart_refinement();
      if (refinement_->done()) facts_.flat = refinement_->flip_flats(lines_.on_lines());
    }
    result.is_cut_short = fitted.is_cut_short;
    note_vertices(result);
    return {};
  }

  const ShapeGoals& goals() const { return options_.quality.shape; }

  void note_vertices(Simplified& result) const {
    const bool has_free =
        std::any_of(domain_.heights.begin(), domain_.heights.end(), [](double z) { return !std::isnan(z); });
    result.vertices = has_free ? Vertices::kFree : Vertices::kSamples;
  }

  /// Adds vertices for angles and sizes of triangles, and those that the bound then needs.
  Result<void> shape(double threshold, Simplified& result) {
    if (!goals().any() || result.stop != StopReason::kMaxError) return {};
    forget_refinement();
    const std::vector<double>& bounds = threshold == bound_ ? bounds_ : aims_;
    SCARP_TRY(const auto& work,
              shape::refine_shapes(snapped_, heights_, domain_, goals(), threshold, bounds, reporter_));
    scanned_ += work.samples_scanned;
    dealt_ += work.triangles_scanned;
    insertions_ += work.insertions;
    note_vertices(result);
    return {};
  }

  /// Sorted: points that broke the bound after fitting, vertices of lines, of which some chords may not be edges, and
  /// vertices whose bounds leave nothing to fit.
  std::vector<std::uint32_t> fixed_points() const {
    std::vector<std::uint32_t> fixed = mended_;
    for (const std::uint32_t point : domain_.point_of) {
      if (point == tin::kNone) continue;
      const bool is_on_line = !lines_.empty() && lines_.on_lines()[point];
      if (is_on_line || (!bounds_.empty() && PointAims(bounds_[point], recipe_.largest).fit <= 0))
        fixed.push_back(point);
    }
    std::sort(fixed.begin(), fixed.end());
    return fixed;
  }

  void forget_refinement() {
    if (!refinement_) return;
    scanned_ += refinement_->points_scanned();
    dealt_ += refinement_->lists_dealt();
    refinement_.reset();
  }

  Result<void> refine(StopReason& stop) {
    const double first_error = refinement_->worst_error();
    best_ = {domain_.point_of.size(), in_last_stretch() ? first_error : std::numeric_limits<double>::infinity()};
    for (std::uint64_t step = 0;; ++step) {
      if (refinement_->done()) {
        stop = options_.max_error ? StopReason::kMaxError : StopReason::kExact;
        return {};
      }
      if (const auto budget = exceeded(refinement_->next_gain())) {
        stop = *budget;
        return {};
      }
      if (refinement_->is_full())
        return fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
      if ((step < 1024 || step % 256 == 0) && reporter_.due() &&
          !reporter_.report("refine", fraction(first_error), domain_.vertex_count(), refinement_->worst_error()))
        return fail(ErrorKind::kCancelled, "cancelled while refining");
      if (wider_ != nullptr && step % 1024 == 0) {
        SCARP_RETURN_IF_ERROR(wider_->check_memory(domain_.vertex_count()));
      }
      refinement_->insert_worst();
      ++insertions_;
      if (in_last_stretch() && refinement_->worst_error() <= best_.error)
        best_ = {domain_.point_of.size(), refinement_->worst_error()};
    }
  }

  double fraction(double first_error) const {
    const double goal = options_.max_error ? bound_ : 0;
    return std::max(budget_.used(size()), error_progress(first_error, refinement_->worst_error(), goal));
  }

  /// Makes the lines chains of edges, and removes flat triangles. Each step may undo the other: chains change
  /// triangles, and new vertices change chains. But the number of vertices only grows.
  Result<void> settle_lines(StopReason& stop) {
    if (lines_.empty()) return {};
    for (;;) {
      const auto splits = lines_.find_splits(refine::find_vertices(domain_, snapped_.size()));
      if (splits.empty()) {
        facts_.loose = lines_.hold(domain_);
        forget_refinement();
        start_refinement();
        if (refinement_->done()) break;
      }
      for (const std::uint32_t point : splits) insert(point);
      SCARP_RETURN_IF_ERROR(refine(stop));
    }
    facts_.flat = refinement_->flip_flats(lines_.on_lines());
    return {};
  }

  void insert(std::uint32_t point) {
    if (refinement_->gain_at(point) == 0) return;
    refinement_->insert(point);
    ++insertions_;
  }

  /// True while the best prefix is searched for.
  bool in_last_stretch() const { return options_.best_of_budget && budget_.in_last_stretch(size()); }

  /// The max error is not monotone, so a budget may stop insertion at a peak. Inserting the first points again restores
  /// an earlier mesh.
  void take_best_prefix() {
    if (fits_ || refinement_->done() || std::isinf(best_.error) || best_.vertices == domain_.point_of.size()) return;
    const std::vector<std::uint32_t> inserted(domain_.point_of.begin() + static_cast<std::ptrdiff_t>(seeds_),
                                              domain_.point_of.begin() + static_cast<std::ptrdiff_t>(best_.vertices));
    refinement_.reset();
    domain_ = *refine::build_domain(snapped_, domain_.outlines);
    for (const std::uint32_t point : inserted) {
      const Point p = snapped_.at[point];
      domain_.insert(point, p, domain_.tin.locate(p, domain_.tin.last_touched()));
    }
  }

  void freeze_into(Simplified& result) const {
    const tin::Triangulation& tin = domain_.tin;
    Mesh& mesh = result.mesh;
    mesh = {};
    const grid::PointLattice& lattice = snapped_.lattice;
    const Point centre{lattice.cols / 2, lattice.rows / 2};
    if (is_on_lattice_) {
      mesh.origin = {lattice.west + lattice.step * centre.x, lattice.north - lattice.step * centre.y, 0};
    } else {
      const auto [x, y] = local_origin(points_);
      mesh.origin = {x, y, 0};
    }
    std::vector<std::uint32_t> ids(tin.vertex_count(), tin::kNone);
    for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
      if (domain_.is_unused(v)) continue;
      ids[v] = static_cast<std::uint32_t>(mesh.vertex_count());
      const Point p = tin.point(v);
      std::array<double, 2> offsets{lattice.step * (p.x - centre.x), lattice.step * (centre.y - p.y)};
      if (!is_on_lattice_) {
        const bool is_free = domain_.is_free(v);
        const std::uint32_t source = is_free ? 0 : snapped_.source[domain_.point_of[v]];
        const double x = is_free ? lattice.west + lattice.step * p.x : points_.x[source];
        const double y = is_free ? lattice.north - lattice.step * p.y : points_.y[source];
        offsets = {x - mesh.origin[0], y - mesh.origin[1]};
      }
      for (std::size_t k = 0; k < 2; ++k) mesh.positions.push_back(round_offset(mesh.origin[k], offsets[k], k));
      mesh.positions.push_back(domain_.height(v, heights_));
    }
    // The lattice's rows count southwards, so a positive triangle is clockwise seen from above.
    for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
      if (tin.is_outside(t)) continue;
      for (const tin::HalfEdge h : {3 * t, 3 * t + 2, 3 * t + 1}) mesh.triangles.push_back(ids[tin.origin(h)]);
    }
    mesh::remove_thin_triangles(mesh, 4 * position_rounding(mesh), thinnest_border_);
    optimize_order(mesh, options_.run.threads);
    result.work.samples_scanned = scanned_ + (refinement_ ? refinement_->points_scanned() : 0);
    result.work.triangles_scanned = dealt_ + (refinement_ ? refinement_->lists_dealt() : 0);
    result.work.passes = insertions_;
  }

  /// An offset from the mesh's origin as it will be stored; `k`: the axis.
  double round_offset(double origin, double offset, std::size_t k) const {
    if (!options_.placement) return options_.float32_positions ? double{static_cast<float>(offset)} : offset;
    const double from = options_.placement->origin[k] - origin, scale = options_.placement->scale[k];
    return double{static_cast<float>((offset - from) * scale)} / scale + from;
  }

  /// Largest distance of vertices from their lattice points along x or y.
  double position_rounding(const Mesh& mesh) const {
    const bool is_rounded = options_.float32_positions || options_.placement;
    if (is_on_lattice_ && !options_.placement) return 0;
    double reach = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (i % 3 != 2) reach = std::max(reach, std::abs(mesh.positions[i]));
    }
    const double snapping = snapped_.is_exact ? 0 : snapped_.lattice.step / 2;
    return std::max(snapping, reach * (is_rounded ? 0x1p-24 : 0x1p-53));
  }

  std::uint32_t point_of_source(std::int32_t source) {
    if (!snapped_.place.empty()) return snapped_.place[static_cast<std::size_t>(source)];
    if (points_by_source_.empty()) {
      points_by_source_.resize(points_.size(), tin::kNone);
      for (std::uint32_t point = 0; point < snapped_.size(); ++point) points_by_source_[snapped_.source[point]] = point;
    }
    return points_by_source_[static_cast<std::size_t>(source)];
  }

  /// Inserts the points that break the bound according to the judge, within the budgets, and continues refinement.
  /// Returns false if that cannot help.
  Result<bool> mend(Simplified& result) {
    if (!refinement_) restart_refinement();
    std::vector<std::uint32_t> offenders;
    stuck_.reset();
    for (const Offender& o : result.measurement.offenders) {
      offenders.push_back(point_of_source(o.col));
      // Rounding of this vertex breaks the bound, and no other vertex can mend that.
      const bool is_vertex = refinement_->gain_at(offenders.back()) == 0;
      if (is_vertex && (!stuck_ || std::abs(o.error) > std::abs(stuck_->error))) stuck_ = o;
    }
    if (offenders.empty() || stuck_) return false;
    for (const std::uint32_t point : offenders) {
      if (const auto budget = exceeded(refinement_->gain_at(point))) {
        result.stop = *budget;
        return true;
      }
      insert(point);
      mended_.push_back(point);
    }
    SCARP_RETURN_IF_ERROR(refine(result.stop));
    const bool is_in_chain =
        !lines_.empty() &&
        std::any_of(offenders.begin(), offenders.end(), [&](std::uint32_t point) { return lines_.on_lines()[point]; });
    if (goals().any()) {
      SCARP_RETURN_IF_ERROR(shape(bound_, result));
      return true;
    }
    if (fits_ && !is_in_chain) return true;
    // Remakes the chains and the mesh around them.
    SCARP_RETURN_IF_ERROR(settle_lines(result.stop));
    take_best_prefix();
    SCARP_RETURN_IF_ERROR(fit(result));
    return true;
  }

  /// Removes thicker slivers along the hull than before. Over a sliver one millimetre high, the surface may rise by
  /// metres, so that the rounding of its corners breaks the bound. False once slivers are as thick as the judge's
  /// tolerance for covered points.
  bool trim_border(const Mesh& mesh) {
    const double thinnest = std::max({8 * thinnest_border_, 32 * position_rounding(mesh), snapped_.lattice.step});
    const double area = snapped_.lattice.step * snapped_.lattice.step * static_cast<double>(snapped_.lattice.cols) *
                        static_cast<double>(snapped_.lattice.rows);
    if (thinnest > std::sqrt(area / static_cast<double>(total())) / 64) return false;
    thinnest_border_ = thinnest;
    return true;
  }

  /// Judges the mesh as it will be written, at the points as they were given. If snapping or float32 positions break
  /// the bound, the points at fault are inserted and refinement continues.
  Result<void> prove(Simplified& result) {
    MeasureOptions judge;
    judge.run.threads = options_.run.threads;
    judge.run.progress = options_.run.progress;
    judge.inlets = options_.boundary_length.has_value();
    if (options_.max_error) judge.collect_above = bound_ + allowance();
    judge.coverage_tolerance *= std::sqrt(static_cast<double>(snapped_.size()) / static_cast<double>(total()));
    judge.tolerance = options_.tolerances;
    for (;;) {
      const auto start = Clock::now();
      SCARP_TRY(result.measurement, judge::judge_points(points_, snapped_, result.mesh, judge));
      result.judged_max_error = result.measurement.max_error;
      result.judged_rmse = result.measurement.rmse;
      result.seconds_measure += seconds_since(start);
      const Measurement& m = result.measurement;
      const bool is_kept = result.stop != StopReason::kMaxError ||
                           (m.max_error <= bound_ + allowance() && m.uncovered == 0 && m.over_tolerance == 0);
      const bool is_sound = m.is_sound();
      bool is_proven = is_sound && is_kept;
      if (is_proven && wider_ != nullptr) {
        SCARP_TRY(is_proven, prove_at_all(result));
        if (!is_proven) {
          freeze_into(result);
          continue;
        }
      }
      if (is_proven) {
        result.passes.push_back({"prove", result.seconds_measure});
        if (goals().any()) result.shape = shape::report_shapes(result.mesh, goals(), domain_.tin, snapped_.lattice);
        return {};
      }
      const auto again = Clock::now();
      SCARP_TRY(const auto& mended, is_sound ? mend(result) : false);
      if (!mended && !trim_border(result.mesh)) return fail(ErrorKind::kPromise, describe_failure(m) + advice(m));
      freeze_into(result);
      result.seconds_refine += seconds_since(again);
    }
  }

  /// Judges the mesh at all points of which those of the run are a part. If some break the bound, refinement continues
  /// with them. Returns true if none does.
  Result<bool> prove_at_all(Simplified& result) {
    const bool has_bound = result.stop == StopReason::kMaxError || result.stop == StopReason::kExact;
    const double bound = has_bound ? bound_ + allowance() : result.measurement.max_error;
    const std::vector<Point> before = snapped_.at;
    const auto start = Clock::now();
    SCARP_TRY(const bool has_grown, wider_->judge(result.mesh, bound, result.measurement));
    result.seconds_measure += seconds_since(start);
    result.judged_max_error = result.measurement.max_error;
    result.judged_rmse = result.measurement.rmse;
    if (!has_grown || !has_bound) return true;
    forget_refinement();
    const auto renumber = [&](std::vector<std::uint32_t>& points) {
      for (std::uint32_t& point : points) {
        if (point != tin::kNone) point = grid::find_point(snapped_, before[point]);
      }
    };
    renumber(domain_.point_of);
    for (auto& outline : domain_.outlines) renumber(outline);
    renumber(mended_);
    points_by_source_.clear();
    // Fitting chooses other vertices, which may break the bound at other points, so it must end.
    constexpr int kMostFits = 4;
    const bool fits_again = fits_ && fits_again_++ < kMostFits;
    if (fits_again)
      start_refinement();
    else
      restart_refinement();
    SCARP_RETURN_IF_ERROR(refine(result.stop));
    if (fits_again) SCARP_RETURN_IF_ERROR(fit(result));
    SCARP_RETURN_IF_ERROR(shape(bound_, result));
    return false;
  }

  std::uint64_t total() const { return wider_ == nullptr ? snapped_.size() : wider_->total(); }

  /// The judge's own double arithmetic rounds.
  double allowance() const { return 1e-12 * (bound_ + largest_height_); }

  std::string describe_broken(const Measurement& m) const {
    if (m.uncovered > 0) return fmt::format("{} points are not covered by the mesh", m.uncovered);
    const auto& [point, bound, error] = find_broken(m);
    return fmt::format("a {} of {} cannot be kept: at ({:.10g}, {:.10g}) the mesh is off by {:.3g}",
                       bound < bound_ ? "tolerance" : "max error", bound, points_.x[point], points_.y[point], error);
  }
  struct Broken {
    std::size_t point;
    double bound, error;
  };
  /// With tolerances, a point that exceeds its tolerance; else the worst point.
  Broken find_broken(const Measurement& m) const {
    if (options_.tolerances.empty() || m.offenders.empty())
      return {static_cast<std::size_t>(m.max_error_at[0]), bound_, m.max_error};
    const Offender& o = stuck_ ? *stuck_ : m.offenders.front();
    return {static_cast<std::size_t>(o.col), recipe_.bound_of(static_cast<std::uint32_t>(o.col)), std::abs(o.error)};
  }
  std::string describe_failure(const Measurement& m) const {
    const grid::PointLattice& lattice = snapped_.lattice;
    const bool is_thin = width_ <= 1e-5 * lattice.step * std::max(lattice.cols, lattice.rows);
    return (is_thin ? fmt::format("all points lie on one line, to {:.2g}, and ", width_) : "") +
           (m.is_sound() ? describe_broken(m) : "the mesh folds over itself");
  }
  std::string advice(const Measurement& m) const {
    const std::string far = grid::describe_far_points(points_);
    if (goals().any())
      return ": points nearly on one line leave no room for such triangles: omit the goals for angles and edges" +
             (far.empty() ? "" : "; " + far);
    const std::string larger = m.is_sound() && m.uncovered == 0
                                   ? fmt::format("ask for at least {:.2g}", round_up(find_broken(m).error))
                                   : std::string("ask for a larger error");
    if (options_.placement)
      return fmt::format(": positions in the print are rounded to float32, which alone costs that much; {}", larger) +
             (far.empty() ? "" : "; " + far);
    return (options_.float32_positions
                ? fmt::format(
                      ": positions in the mesh are rounded to float32, which alone costs that much; {}, or write "
                      "OBJ or PLY, whose positions are double",
                      larger)
                : fmt::format(": points are snapped to a lattice of step {:.3g}, which alone costs that much; {}, or "
                              "split the points into smaller areas",
                              snapped_.lattice.step, larger)) +
           (far.empty() ? "" : "; " + far);
  }
  /// Rounds up to two digits.
  static double round_up(double error) {
    const double unit = std::pow(10.0, std::floor(std::log10(error)) - 1);
    return std::ceil(error / unit) * unit;
  }

  const PointSet& points_;
  const grid::SnappedPoints& snapped_;
  const std::vector<double>& heights_;
  const PointRecipe& recipe_;
  const PointOptions& options_;
  const refine::PointLines& lines_;
  WiderProof* wider_;  ///< null: these are all points
  pieces::Budget budget_;
  double bound_;
  std::string least_;
  double width_;
  bool fits_;           ///< vertices are removed
  bool is_on_lattice_;  ///< vertices lie on the lattice, which float32 holds
  double largest_height_ = 0, thinnest_border_ = 0;
  std::vector<double> bounds_, aims_;  ///< by point, with tolerances: the bound, and that for fitting
  refine::ScatteredDomain domain_;
  std::size_t seeds_;
  std::optional<refine::ScatteredRefinement> refinement_;
  std::vector<std::uint32_t> points_by_source_, mended_;
  std::optional<Offender> stuck_;  ///< a vertex that breaks its bound
  int fits_again_ = 0;
  std::uint64_t insertions_ = 0, scanned_ = 0, dealt_ = 0;
  PointFacts facts_;
  Reporter reporter_;
  pieces::Prefix best_{0, std::numeric_limits<double>::infinity()};
};

}  // namespace

Result<PointMesh> run_points(const PointTask& task, const PointRecipe& recipe, refine::ScatteredDomain domain) {
  const auto start = Clock::now();
  PointRun run(task, recipe, std::move(domain));
  PointMesh made;
  SCARP_TRY(made.simplified, run.execute(start));
  made.facts = run.facts();
  return made;
}

}  // namespace scarp::run
