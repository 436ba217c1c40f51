// The main job as a list of passes. Milestones: after `build_domain`, or in each tile after `start_tile`, the outline
// is fixed; after `refine` and `take_best_prefix`, or after the tiles, no vertex is added, after `remove_vertices`
// none removed; after `freeze` nothing moves; what `prove` has seen is what is returned.
#include "simplify/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/sort.h"
#include "fit/fit.h"
#include "grid/samples.h"
#include "lines/constraints.h"
#include "metric/height_metric.h"
#include "metric/source_metric.h"
#include "pieces/effort.h"
#include "pieces/freeze.h"
#include "pieces/goals.h"
#include "pieces/locked_border.h"
#include "pieces/passes.h"
#include "pieces/release.h"
#include "pieces/source_windows.h"
#include "pieces/vertex_attributes.h"
#include "refine/domain.h"
#include "refine/refinement.h"
#include "refine/settle_edges.h"
#include "shape/shape_need.h"
#include "shape/shape_refinement.h"
#include "simplify/proof.h"
#include "tin/border_count.h"

namespace scarp {

namespace {

/// One run of the engine towards the goals.
class EngineRun {
 public:
  EngineRun(const Plan& plan, const Raster& raster, const Criterion& criterion, const ConstraintGraph* lines,
            std::span<const Point> border)
      : plan_(plan),
        field_(plan.field),
        raster_(raster),
        options_(plan.options),
        criterion_(criterion),
        lines_(lines),
        border_(border),
        budget_(options_),
        exact_(lattice_is_exact(field_, options_, lines == nullptr ? 1 : kLatticeSteps)),
        reporter_(options_.run.progress) {}

  /// In the dominant order where `tiled` is given, else greedily.
  Result<Simplified> execute(std::optional<Tiled> tiled) {
    const auto start = Clock::now();
    Simplified result;
    result.ignored = criterion_.ignored();
    result.order = tiled ? Order::kDominant : Order::kGreedy;
    result.effort = options_.quality.effort;
    auto refined = tiled ? free_seams(std::move(*tiled), result) : insert_greedily(result);
    if (!refined) return tl::unexpected(refined.error());
    if (auto inserted = insert_lines(result); !inserted) return tl::unexpected(inserted.error());
    const auto shaped = fit_and_shape(result);
    if (!shaped) return tl::unexpected(shaped.error());
    if (auto kept = check_border(); !kept) return tl::unexpected(kept.error());
    // Vertices that lie exactly on their samples keep the bound by construction: nothing will be inserted after the
    // proof.
    const bool is_final = result.stop != StopReason::kMaxError || exact_ || !piece_->lattice.are_samples();
    if (is_final) refinement_.reset();
    freeze_into(result, is_final);
    result.seconds_refine += seconds_since(start);
    if (is_useless({result.mesh.vertex_count(), result.mesh.triangle_count()})) return result;
    if (!is_final) {
      if (auto looked = mend_ahead(result); !looked) return tl::unexpected(looked.error());
      order(result);
    }
    if (auto proven = prove_and_mend(result); !proven) return tl::unexpected(proven.error());
    count_looser_outline(result);
    if (options_.quality.shape.any()) result.shape = report_shapes(result.mesh, options_.quality.shape, shaped->forced);
    return result;
  }

 private:
  /// Adds a pass that began at `start`.
  static void record(Simplified& result, std::string_view name, Clock::time_point start, const Work& work = {}) {
    result.passes.push_back({name, seconds_since(start), work.samples_scanned, work.triangles_scanned, work.passes});
  }

  Result<void> insert_greedily(Simplified& result) {
    auto start = Clock::now();
    auto domain = build_domain(raster_, options_.domain.outline_tolerance, field_.frame);
    if (!domain) return tl::unexpected(domain.error());
    take(std::move(*domain));
    insert_points();
    record(result, "domain", start);
    if (inserts_first()) return {};
    start = Clock::now();
    refinement_.emplace(criterion_.metric(), piece_->tin, options_.strategy.algorithm, options_.strategy.edges);
    const char* culprit = !border_.empty() ? "the locked border and the outline of the valid data alone need"
                          : options_.features.points.empty() ? "the outline of the valid data alone needs"
                                                             : "the outline of the valid data and the points need";
    const char* advice = is_whole_ ? "" : ", or simplify the outline with an outline tolerance";
    if (auto fits = budget_.check(size(), culprit, advice); !fits) return fits;
    if (auto refined = refine(result.stop); !refined) return refined;
    finish_edges(result);
    record(result, "refine", start, result.work);
    return {};
  }

  /// The tiles' mesh becomes one. What the largest bound of all leaves to the others is refined; so is, in curved
  /// frames, what breaks where its border is fitted to the samples.
  Result<void> free_seams(Tiled tiled, Simplified& result) {
    const auto start = Clock::now();
    take(std::move(tiled.domain));
    if (!border_.empty()) on_sides_ = find_side_vertices(piece_->tin, raster_, 1);
    heights_ = std::move(tiled.heights);
    result.work = tiled.work;
    if (plan_.finishes_strips) {
      // Later whole-mesh passes have no raster, so heights are stored per vertex.
      if (options_.quality.shape.any() && tiled.steps == 1) piece_->tin.scale(tiled.steps = kLatticeSteps);
      piece_->lattice = {tiled.steps, tiled.steps > 1 ? std::move(heights_) : std::vector<float>(),
                         std::move(tiled.fixed)};
      note_vertices(result);
    } else if (plan_.is_streamed && plan_.scale.squares) {
      piece_->tin.scale(kLatticeSteps);
      piece_->lattice = {kLatticeSteps, std::move(heights_), {}};
    } else if (!plan_.is_streamed || field_.source->is_in_memory()) {
      const HeightMetric of_tiles(raster_, criterion_.largest_aim());
      const ErrorMetric& metric = criterion_.bounds().empty() ? criterion_.metric() : of_tiles;
      const Work work = release_seams(piece_->tin, metric, std::move(tiled.seams), options_.run.threads);
      result.work.samples_scanned += work.samples_scanned;
      result.work.triangles_scanned += work.triangles_scanned;
      record(result, "seams", start, work);
    }
    if (!field_.frame.transform && criterion_.bounds().empty()) return {};
    const auto again = Clock::now();
    if (field_.frame.transform) follow_curved_border(raster_, piece_->tin, field_.frame);
    refinement_.emplace(criterion_.metric(), piece_->tin);
    auto refined = refine(result.stop);
    record(result, "refine", again, refinement_->work());
    return refined;
  }

  /// Whether there are walls or ridges: what refinement would do there without them, it need not do with them.
  bool inserts_first() const { return lines_ != nullptr && lines_->is_inserted_first; }

  /// Samples outside the domain cannot become vertices.
  void insert_points() {
    for (const Point p : border_) insert_seed(p);
    if (!border_.empty()) on_sides_ = find_side_vertices(piece_->tin, raster_, 1);
    for (const auto& [col, row] : options_.features.points) insert_seed({col, row});
    seeds_ = piece_->tin.vertex_count();
  }
  void insert_seed(Point p) {
    const Triangulation& tin = piece_->tin;
    const auto location = tin.locate(p, tin.last_touched());
    const HalfEdge twin = location.kind == Triangulation::Location::Kind::kOnEdge ? tin.twin(location.edge) : kNone;
    const bool inside = !tin.is_outside(location.edge / 3) || (twin != kNone && !tin.is_outside(twin / 3));
    if (inside && raster_.is_valid(p)) piece_->tin.insert(p, location);
  }

  /// No pass has a reason to touch a locked border; this is the proof that none did.
  Result<void> check_border() const {
    if (border_.empty()) return {};
    std::vector<Point> expected = on_sides_;
    for (Point& p : expected) p = {p.x * piece_->lattice.steps, p.y * piece_->lattice.steps};
    if (find_side_vertices(piece_->tin, raster_, piece_->lattice.steps) == expected) return {};
    return fail(ErrorKind::kPromise,
                "the locked border cannot be kept: heights differ too much in magnitude for its line");
  }

  /// Points stay, whatever removal could do without.
  void fix_points() {
    const Triangulation& tin = piece_->tin;
    std::vector<Point> asked;
    for (const auto& [col, row] : options_.features.points)
      asked.push_back({col * piece_->lattice.steps, row * piece_->lattice.steps});
    if (asked.empty()) return;
    sort_rarely(asked, before);
    piece_->lattice.fixed.resize(tin.vertex_count(), 0);
    for (Vertex v = 0; v < tin.vertex_count(); ++v) {
      if (std::binary_search(asked.begin(), asked.end(), tin.point(v), before)) piece_->lattice.fixed[v] = 1;
    }
  }

  void take(DomainMesh domain) {
    is_whole_ = domain.whole;
    unused_ = domain.unused;
    piece_.emplace(Piece{raster_, 0, std::move(domain.tin)});
  }

  std::uint64_t vertices() const { return piece_->tin.vertex_count() - unused_; }

  /// See Scale::room.
  bool is_useless(const MeshSize& size) const { return plan_.scale.room && plan_.scale.room->used(size) > 1; }

  MeshSize size() const { return {vertices(), refinement_->triangle_count()}; }
  std::optional<StopReason> exceeded(std::uint32_t gain) const { return budget_.exceeded(size(), gain); }

  std::optional<StopReason> reached() const {
    if (refinement_->done()) return criterion_.has_error_goal() ? StopReason::kMaxError : StopReason::kExact;
    return exceeded(refinement_->next_gain());
  }

  /// Every way of refinement is steps of one or more insertions, with a look at goals, progress and the best prefix
  /// after each.
  Result<void> refine(StopReason& stop) {
    const double first_error = refinement_->worst_error();
    best_ = {piece_->tin.vertex_count(), in_last_stretch() ? first_error : std::numeric_limits<double>::infinity()};
    for (std::uint64_t step = 0;; ++step) {
      if (const auto reason = reached()) {
        stop = *reason;
        return {};
      }
      if (refinement_->is_full()) return fail(ErrorKind::kInput, kTooManyTriangles);
      if ((step < 1024 || step % 256 == 0 || options_.strategy.batch.rule != Batch::Rule::kSequential) &&
          reporter_.due() && !reporter_.report("refine", fraction(first_error), vertices(), refinement_->worst_error()))
        return fail(ErrorKind::kCancelled, "cancelled while refining");
      if (step % 256 == 0) {
        if (auto fits = plan_.memory.check_mesh(0, vertices(), fraction(first_error)); !fits) return fits;
      }
      if (const auto budget = take_step()) {
        stop = *budget;
        return {};
      }
      if (in_last_stretch() && refinement_->worst_error() <= best_.error)
        best_ = {piece_->tin.vertex_count(), refinement_->worst_error()};
    }
  }

  /// Returns the budget that stopped it. REQUIRES: !reached().
  std::optional<StopReason> take_step() {
    if (options_.strategy.batch.rule != Batch::Rule::kSequential) return insert_batch();
    if (options_.strategy.importance.one_pass) return insert_ranked();
    refinement_->insert_worst();
    return std::nullopt;
  }

  std::optional<StopReason> insert_batch() {
    std::optional<StopReason> budget;
    for (const auto& [candidate, triangle] : refinement_->collect(options_.strategy.batch)) {
      if (options_.strategy.batch.rule == Batch::Rule::kIndependent && refinement_->has_changed(triangle)) continue;
      const std::uint32_t gain = refinement_->gain_near(candidate.at, triangle);
      if (gain == 0) continue;  // on an edge, named by both triangles
      budget = exceeded(gain);
      if (budget || refinement_->is_full()) break;
      refinement_->insert_unseen(candidate.at, triangle);
    }
    refinement_->rescan_changed();
    return budget;
  }

  std::optional<StopReason> insert_ranked() {
    if (!ranking_) ranking_ = criterion_.ranking();
    while (ranked_ < ranking_->size()) {
      const Point p = (*ranking_)[ranked_];
      const std::uint32_t gain = refinement_->gain_at(p);
      if (const auto budget = gain == 0 ? std::nullopt : exceeded(gain)) return budget;
      ++ranked_;
      if (gain == 0) continue;
      refinement_->insert(p);
      return std::nullopt;
    }
    refinement_->insert_worst();
    return std::nullopt;
  }

  double fraction(double first_error) const {
    const double goal = criterion_.has_error_goal() ? criterion_.metric().goal() : 0;
    return std::max(budget_.used(size()), error_progress(first_error, refinement_->worst_error(), goal));
  }

  /// Where the best prefix is looked for.
  bool in_last_stretch() const {
    return options_.strategy.best_of_budget && criterion_.importance_is_error() &&
           !options_.strategy.importance.one_pass && budget_.in_last_stretch(size());
  }

  /// Max error is not monotone: a budget may stop on a spike. Insertion is deterministic, so an earlier mesh is had by
  /// inserting the same points again, without looking at a sample.
  void take_best_prefix() {
    if (refinement_->done() || std::isinf(best_.error) || best_.vertices == piece_->tin.vertex_count()) return;
    std::vector<Point> points;
    for (std::size_t v = seeds_; v < best_.vertices; ++v) points.push_back(piece_->tin.point(static_cast<Vertex>(v)));
    refinement_.reset();
    take(*build_domain(raster_, options_.domain.outline_tolerance, field_.frame));
    insert_points();
    std::optional<DataDependentRule> rule;
    if (options_.strategy.edges.data_dependent) rule.emplace(criterion_.metric(), options_.strategy.edges);
    Triangulation& tin = piece_->tin;
    for (Point p : points) {
      const auto location = tin.locate(p, tin.last_touched());
      rule ? rule->insert(tin, p, location) : tin.insert(p, location);
    }
  }

  void finish_edges(Simplified& result) {
    result.work = refinement_->work();
    take_best_prefix();
    const Work settling = settle_edges(piece_->tin, criterion_.metric(), options_.strategy.edges,
                                       result.stop == StopReason::kMaxError || result.stop == StopReason::kExact);
    result.work.samples_scanned += settling.samples_scanned;
    result.work.triangles_scanned += settling.triangles_scanned;
  }

  /// Lines become chains of edges; what they break is refined around them.
  Result<void> insert_lines(Simplified& result) {
    if (lines_ == nullptr) return {};
    const auto start = Clock::now();
    refinement_.reset();
    piece_->aims = criterion_.aims();
    piece_->is_refined = !inserts_first();
    piece_->check = [this](std::uint64_t count, double share, double error) -> Result<void> {
      if (reporter_.due() && !reporter_.report("lines", share, count - unused_, error))
        return fail(ErrorKind::kCancelled, "cancelled while inserting lines");
      return plan_.memory.check_mesh(0, count - unused_, share);
    };
    Work work;
    const ConstraintGoals goals{criterion_.aim(), plan_.fits && plan_.releases_starts, options_.run.threads};
    if (auto inserted = insert_constraints(*piece_, *lines_, goals, work); !inserted) return inserted;
    if (!piece_->has_surface) return fail(ErrorKind::kInput, kNothingInCutline);
    if (inserts_first()) result.work = work;
    record(result, "lines", start, work);
    return {};
  }

  Result<ShapeWork> fit_and_shape(Simplified& result) {
    if (!plan_.removes_last) {
      if (auto fitted = remove_vertices(result); !fitted) return tl::unexpected(fitted.error());
    }
    auto shaped = add_for_shapes(result);
    if (!shaped || !plan_.removes_last) return shaped;
    if (auto fitted = remove_vertices(result); !fitted) return tl::unexpected(fitted.error());
    return shaped;
  }

  /// Vertices that the bound can do without go.
  Result<void> remove_vertices(Simplified& result) {
    if (!plan_.fits || (plan_.fits_strips && !options_.quality.shape.any())) return {};
    const auto start = Clock::now();
    refinement_.reset();
    fix_points();
    std::optional<Criterion> whole;
    if (plan_.scale.start < 1) {
      auto made = Criterion::make(field_, options_, raster_, plan_.aim, plan_.scale.factor);
      if (!made) return tl::unexpected(made.error());
      whole.emplace(std::move(*made));
    }
    const Criterion& criterion = whole ? *whole : criterion_;
    FitOptions options = fit_options(field_, options_, criterion.aim());
    options.squares = plan_.scale.squares;
    if (options.squares && options.squares->most_vertices != kNoBudget) options.squares->most_vertices += unused_;
    piece_->aims = criterion.aims();
    const auto norm = fit_norm(options_, raster_, criterion);
    if (norm) options.norm = &*norm;
    if (plan_.is_streamed) read_windows(field_, plan_.memory, options, criterion_.source_bounds());
    options.threads = fit_threads(window_bytes(options));
    const std::uint64_t windows = window_bytes(options) * static_cast<unsigned>(options.threads);
    if (auto fits = plan_.memory.check_mesh(windows, vertices(), 1); !fits) return fits;
    Reporter reporter(options_.run.progress);
    if (options_.run.progress) {
      options.progress = [&](double share, std::uint64_t vertices) {
        return !reporter.due() || reporter.report("fit", share, vertices, 0);
      };
    }
    const auto fitted = fit_piece(*piece_, std::move(options));
    if (!fitted) return tl::unexpected(fitted.error());
    note_vertices(result);
    result.is_cut_short = fitted->is_cut_short;
    record(result, "fit", start);
    result.passes.back().removals = fitted->removed;
    return {};
  }

  /// Vertices that angles and sizes of triangles need come, and others that the bound then needs.
  Result<ShapeWork> add_for_shapes(Simplified& result) {
    if (!options_.quality.shape.any()) return ShapeWork{};
    const auto start = Clock::now();
    refinement_.reset();
    ShapeTask task{options_.quality.shape, field_.frame.affine, criterion_.aim(), criterion_.aims()};
    task.all_may_go = plan_.releases_starts;
    std::uint64_t rows = 0;
    if (plan_.is_streamed) {
      task.field = &field_;
      task.source_bounds = criterion_.source_bounds();
      task.rows_at_once = rows_at_once(field_, plan_.memory, task.source_bounds);
      rows = bytes_at_once(field_, plan_.memory, task.source_bounds);
    }
    const auto before = static_cast<double>(piece_->tin.vertex_count());
    task.progress = [&](double share, std::uint64_t count, double error) -> Result<void> {
      if (reporter_.due() && !reporter_.report("shape", 0, count, error))
        return fail(ErrorKind::kCancelled, "cancelled while refining shapes");
      const auto now = static_cast<double>(count);
      return plan_.memory.check_mesh(rows, count, now / (before + (now - before) / share));
    };
    task.foresee = [&](double triangles) { return check_need(triangles, plan_.memory, rows); };
    auto work = refine_shapes(raster_, piece_->tin, piece_->lattice, task);
    if (!work) return work;
    note_vertices(result);
    result.passes.push_back(
        {"shape", seconds_since(start), work->samples_scanned, work->triangles_scanned, work->insertions});
    return work;
  }

  /// After fitting.
  void note_vertices(Simplified& result) {
    exact_ = plan_.is_exact;
    if (plan_.frees_vertices && !piece_->lattice.are_samples()) result.vertices = Vertices::kFree;
  }

  /// As many as the memory leaves room for, each with a window of samples.
  int fit_threads(std::uint64_t window) const {
    const int threads = thread_count(options_.run.threads);
    if (!plan_.memory.is_limited()) return threads;
    const std::uint64_t vertices = piece_->tin.vertex_count(), taken = plan_.memory.per_vertex * vertices;
    const std::uint64_t most =
        (std::max(plan_.memory.rest(), taken) - taken) / (kFitBytesPerVertexAndThread * vertices + window);
    return static_cast<int>(std::clamp<std::uint64_t>(most, 1, static_cast<std::uint64_t>(threads)));
  }

  /// The field as refinement sees it; in space, where that is another, as it was given.
  HeightField clean_field() const {
    HeightField clean = field_;
    if (!plan_.is_streamed && !field_.frame.space) clean.samples = raster_.samples;
    return clean;
  }

  void order(Simplified& result) const {
    const auto start = Clock::now();
    optimize_order(result.mesh, options_.run.threads);
    record(result, "order", start);
    result.seconds_refine += seconds_since(start);
  }

  /// The last time the workbench's memory is given back on the way, and the mesh is put in order unless it is useless.
  void freeze_into(Simplified& result, bool is_last) {
    const auto start = Clock::now();
    if (!is_whole_ && !plan_.has_lines) result.outline_triangles = count_border_triangles(piece_->tin);
    const HeightField clean = clean_field();
    const Raster given{clean.samples, raster_.cols, raster_.rows};
    const SampleHeights heights = !plan_.is_streamed ? SampleHeights(given) : SampleHeights(field_, heights_);
    const VertexPositions way{heights, piece_->lattice, field_.frame, rounds_offsets(field_, options_)};
    const bool has_more = has_attributes(field_, options_);
    const int threads = options_.run.threads;
    LatticePoints at;
    double seconds_of_order = 0;
    if (is_last) {
      MeltDown melting(std::move(piece_->tin), way, threads);
      if (!is_useless({melting.vertex_count(), melting.triangle_count()})) {
        const auto order_start = Clock::now();
        melting.order();
        seconds_of_order = seconds_since(order_start);
      }
      result.mesh = melting.finish();
      if (has_more) at = melting.points();
      piece_.reset();
    } else {
      result.mesh = freeze(piece_->tin, way, threads);
      if (has_more) at = frozen_points(piece_->tin, piece_->lattice);
    }
    if (const double step = height_step(field_, options_); step > 0) round_heights(result.mesh, step);
    add_attributes(clean, options_, at, result.mesh);
    result.passes.push_back({"freeze", seconds_since(start) - seconds_of_order});
    if (seconds_of_order > 0) result.passes.push_back({"order", seconds_of_order});
  }

  /// Where the outline takes most of the mesh.
  void count_looser_outline(Simplified& result) const {
    if (options_.domain.outline_tolerance > 0 || plan_.is_streamed || result.outline_triangles == 0) return;
    if (2 * result.outline_triangles < result.mesh.triangle_count()) return;
    const auto domain = build_domain(raster_, 1, field_.frame);
    if (domain) result.outline_triangles_at_one = count_border_triangles(domain->tin);
  }

  /// Inserts the samples that break the bound in the judge's eyes, as far as the budgets allow, and refines on. Returns
  /// false if that cannot help.
  Result<bool> mend(std::vector<Offender> offenders, Simplified& result) {
    if (!refinement_)
      refinement_.emplace(criterion_.metric(), piece_->tin, options_.strategy.algorithm, options_.strategy.edges,
                          Refinement::Start::kClean);
    // A vertex among them: its own rounding breaks the bound, and no other vertex can mend that.
    const auto is_vertex = [this](const Offender& o) { return refinement_->gain_at({o.col, o.row}) == 0; };
    // Where a fold is to go, any sample may be named.
    const auto is_useless = [&](const Offender& o) {
      return std::isinf(o.error) && (!raster_.is_valid({o.col, o.row}) || is_vertex(o));
    };
    if (field_.frame.space)
      offenders.erase(std::remove_if(offenders.begin(), offenders.end(), is_useless), offenders.end());
    const auto is_locked = [this](const Offender& o) {
      return !border_.empty() && (o.col == 0 || o.row == 0 || o.col == raster_.cols - 1 || o.row == raster_.rows - 1);
    };
    if (std::any_of(offenders.begin(), offenders.end(), is_locked)) return false;
    if (offenders.empty() || std::any_of(offenders.begin(), offenders.end(), is_vertex)) return false;
    std::optional<StopReason> budget;
    for (const Offender& o : offenders) {
      const std::uint32_t gain = refinement_->gain_at({o.col, o.row});
      if (gain == 0) continue;  // named by two triangles
      budget = exceeded(gain);
      if (budget) break;
      refinement_->insert({o.col, o.row});
    }
    if (budget) {
      result.stop = *budget;
      return true;
    }
    if (auto refined = refine(result.stop); !refined) return tl::unexpected(refined.error());
    finish_edges(result);
    return true;
  }

  /// What the first proof would find is looked for before the mesh is put in order and its topology judged, which take
  /// longer. What this cannot mend is left to the proof.
  Result<void> mend_ahead(Simplified& result) {
    const auto start = Clock::now();
    const auto found = prove(field_, options_, criterion_, exact_, Look::kHeights, result);
    if (!found) return tl::unexpected(found.error());
    result.seconds_measure += seconds_since(start);
    record(result, "prove", start);
    if (found->kept) return {};
    const auto again = Clock::now();
    const auto mended = mend(found->offenders, result);
    if (!mended) return tl::unexpected(mended.error());
    if (!*mended) return {};
    record(result, "refine", again);
    freeze_into(result, false);
    result.seconds_refine += seconds_since(again);
    return {};
  }

  /// Judges the mesh as it will be written. Where float32 positions or the frame's curvature cost the bound, or fold
  /// the mesh in space, the samples that break it are inserted and refinement goes on.
  Result<void> prove_and_mend(Simplified& result) {
    for (;;) {
      const auto start = Clock::now();
      const auto proof = prove(field_, options_, criterion_, exact_, Look::kAll, result);
      if (!proof) return tl::unexpected(proof.error());
      result.seconds_measure += seconds_since(start);
      record(result, "prove", start);
      const bool is_sound = exact_ || result.measurement.is_sound();
      // In space a fold goes where its longest edge is split.
      const bool may_unfold = field_.frame.space && result.measurement.down_facing > 0 && !proof->offenders.empty();
      if (!is_sound && !may_unfold)
        return fail(ErrorKind::kPromise,
                    "the mesh folds over itself: in this frame positions are rounded to float32, or edges are straight "
                    "where the grid's are curved; ask for a smaller error, or write in the local or grid frame");
      if (proof->kept && is_sound) return {};
      if (!piece_) return fail(exact_ ? ErrorKind::kInternal : ErrorKind::kPromise, proof->broken);
      const auto again = Clock::now();
      const auto mended = mend(proof->offenders, result);
      if (!mended) return tl::unexpected(mended.error());
      if (!*mended)
        return fail(ErrorKind::kPromise,
                    (proof->kept ? "the mesh folds over itself" : proof->broken) +
                        (rounds_offsets(field_, options_)
                             ? ": positions in the mesh are rounded to float32, which alone costs that much; ask for a "
                               "larger error, or write OBJ or PLY, whose positions are double, or use the local or "
                               "grid frame"
                             : ": positions in the mesh are rounded to double, which alone costs that much; ask for a "
                               "larger error, or use the local or grid frame"));
      record(result, "refine", again);
      freeze_into(result, false);
      result.seconds_refine += seconds_since(again);
      order(result);
    }
  }

  const Plan& plan_;
  const HeightField& field_;
  const Raster& raster_;
  const Request& options_;
  const Criterion& criterion_;
  const ConstraintGraph* lines_;
  std::span<const Point> border_;  // a locked one's vertices
  std::vector<Point> on_sides_;    // there when refinement begins, where a border is locked
  Budget budget_;
  std::optional<Piece> piece_;  // all of the raster: given back as soon as nothing can need it any more
  bool is_whole_ = true;        // every sample is a height
  std::uint32_t unused_ = 0;    // corners of the rectangle that are no vertex of the domain
  std::vector<float> heights_;  // of its vertices, where the field has a source
  std::size_t seeds_ = 0;
  std::optional<Refinement> refinement_;
  bool exact_;  // every vertex can lie exactly on its sample, or on the lattice of fitting
  Reporter reporter_;
  std::optional<std::vector<Point>> ranking_;
  std::size_t ranked_ = 0;
  Prefix best_{0, std::numeric_limits<double>::infinity()};
};

}  // namespace

Result<Simplified> run_passes(const Plan& plan, const Raster& raster, const Criterion& criterion,
                              const ConstraintGraph* lines, std::optional<Tiled> tiled, std::span<const Point> border) {
  return EngineRun(plan, raster, criterion, lines, border).execute(std::move(tiled));
}

}  // namespace scarp
