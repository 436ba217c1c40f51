// The main job as a list of passes. Milestones: the outline is fixed after the seeds, or in each tile after
// `start_tile`. No vertex is added after the refinement or the tiles, none is removed after `remove_vertices`, and none
// moves after `freeze`. The returned mesh is the one that `prove` has judged.
#include "simplify/mesh_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/sort.h"
#include "fit/fit.h"
#include "grid/samples.h"
#include "lines/constraints.h"
#include "metric/height_metric.h"
#include "pieces/freeze.h"
#include "pieces/passes.h"
#include "pieces/release.h"
#include "pieces/source_windows.h"
#include "pieces/vertex_attributes.h"
#include "refine/domain.h"
#include "shape/shape_need.h"
#include "shape/shape_refinement.h"
#include "simplify/goal_refinement.h"
#include "simplify/pass_work.h"
#include "simplify/proof.h"
#include "tin/border_count.h"

namespace scarp::run {

namespace {

static_assert(fit::kMostFitFields > kMaxChannels);

/// The norm that fitting bounds; nothing if only unweighted heights matter. The criterion must stay alive.
std::optional<fit::FitNorm> fit_norm(const SimplifyOptions& options, const grid::Raster& raster,
                                     const metric::Criterion& criterion) {
  const std::vector<metric::MetricField> fields = criterion.metric_fields();
  if (fields.size() == 1 && fields[0].samples == raster.samples && fields[0].scale == 1) return std::nullopt;
  fit::FitNorm norm;
  for (const metric::MetricField& field : fields) norm.fields.push_back({field.samples, field.scale});
  norm.norm = options.goals.norm;
  norm.find_breach = [&metric = criterion.metric()](const std::array<Point, 3>& corners) {
    const auto candidate = metric.find_candidate(corners, metric.fit(corners, {}));
    return candidate ? std::optional(candidate->at) : std::nullopt;
  };
  return norm;
}

/// The passes over the whole mesh, towards the goals.
class MeshPasses {
 public:
  MeshPasses(const pieces::Recipe& recipe, const grid::Raster& raster, const metric::Criterion& criterion,
             const lines::ConstraintGraph* lines, std::span<const Point> border)
      : recipe_(recipe),
        field_(recipe.field),
        raster_(raster),
        options_(recipe.options),
        criterion_(criterion),
        lines_(lines),
        exact_(lines == nullptr ? recipe.is_exact_on_samples : recipe.is_exact),
        reporter_(options_.run.progress),
        refinement_(recipe, raster, criterion, border, reporter_) {}

  /// Runs from the tiles of the dominant order if `tiled` is given, else greedily.
  Result<Simplified> execute(std::optional<pieces::Tiled> tiled) {
    const auto start = Clock::now();
    Simplified result;
    result.ignored = criterion_.ignored();
    result.order = tiled ? Order::kDominant : Order::kGreedy;
    result.effort = recipe_.effort;
    SCARP_RETURN_IF_ERROR(tiled ? free_seams(std::move(*tiled), result) : insert_greedily(result));
    SCARP_RETURN_IF_ERROR(insert_lines(result));
    SCARP_RETURN_IF_ERROR(fit_and_shape(result));
    SCARP_RETURN_IF_ERROR(refinement_.check_border());
    const ShapeGoals& shape = options_.quality.shape;
    const auto losses = shape.any() ? shape::count_losses(refinement_.piece().tin, refinement_.piece().lattice.steps,
                                                          field_.frame, shape)
                                    : shape::ShapeLosses{};
    // If all vertices are exactly on their samples, the bound holds by construction, and no vertex is inserted after
    // the proof.
    const bool is_final = result.stop != StopReason::kMaxError || exact_ || !refinement_.piece().lattice.are_samples();
    if (is_final) refinement_.forget();
    freeze_into(result, is_final);
    result.seconds_refine += seconds_since(start);
    if (is_useless({result.mesh.vertex_count(), result.mesh.triangle_count()})) return result;
    if (!is_final) {
      SCARP_RETURN_IF_ERROR(mend_ahead(result));
      order(result);
    }
    SCARP_RETURN_IF_ERROR(prove_and_mend(result));
    count_looser_outline(result);
    if (shape.any()) result.shape = shape::report_shapes(result.mesh, shape, losses);
    return result;
  }

 private:
  Result<void> insert_greedily(Simplified& result) {
    SCARP_RETURN_IF_ERROR(refinement_.start(result));
    if (inserts_first()) return {};
    return refinement_.run(result);
  }

  /// Joins the tiles' meshes. Refines samples with bounds below the largest and, in curved frames, samples whose bound
  /// breaks where the border is fitted to the samples.
  Result<void> free_seams(pieces::Tiled tiled, Simplified& result) {
    const auto start = Clock::now();
    refinement_.start_with(std::move(tiled.domain));
    pieces::Piece& piece = refinement_.piece();
    heights_ = std::move(tiled.heights);
    result.work = tiled.work;
    if (recipe_.finishes_strips) {
      // Later passes over the whole mesh have no raster, so heights are stored per vertex.
      if (options_.quality.shape.any() && tiled.steps == 1) piece.tin.scale(tiled.steps = grid::kLatticeSteps);
      piece.lattice = {tiled.steps, tiled.steps > 1 ? std::move(heights_) : std::vector<float>(),
                       std::move(tiled.fixed)};
      note_vertices(result);
    } else if (recipe_.is_streamed && recipe_.scale.squares) {
      piece.tin.scale(grid::kLatticeSteps);
      piece.lattice = {grid::kLatticeSteps, std::move(heights_), {}};
    } else if (!recipe_.is_streamed || field_.source->is_in_memory()) {
      const metric::HeightMetric of_tiles(raster_, criterion_.largest_aim());
      const metric::ErrorMetric& metric = criterion_.bounds().empty() ? criterion_.metric() : of_tiles;
      const Work work = pieces::release_seams(piece.tin, metric, std::move(tiled.seams), options_.run.threads);
      result.work.samples_scanned += work.samples_scanned;
      result.work.triangles_scanned += work.triangles_scanned;
      result.passes.push_back(pass_of("seams", seconds_since(start), work));
    }
    if (!field_.frame.transform && criterion_.bounds().empty()) return {};
    if (field_.frame.transform) refine::follow_curved_border(raster_, piece.tin, field_.frame);
    return refinement_.run_on(result);
  }

  /// True if there are walls or ridges: lines that are in the mesh before refinement save vertices.
  bool inserts_first() const { return lines_ != nullptr && lines_->is_inserted_first; }

  /// Fixes points, so that removal keeps them.
  void fix_points() {
    pieces::Piece& piece = refinement_.piece();
    std::vector<Point> asked;
    for (const auto& [col, row] : options_.features.points)
      asked.push_back({col * piece.lattice.steps, row * piece.lattice.steps});
    if (asked.empty()) return;
    sort_rarely(asked, before);
    piece.lattice.fixed.resize(piece.tin.vertex_count(), 0);
    for (tin::Vertex v = 0; v < piece.tin.vertex_count(); ++v) {
      if (std::binary_search(asked.begin(), asked.end(), piece.tin.point(v), before)) piece.lattice.fixed[v] = 1;
    }
  }

  /// See Scale::room.
  bool is_useless(const pieces::MeshSize& size) const {
    return recipe_.scale.room && recipe_.scale.room->used(size) > 1;
  }

  /// Makes the lines chains of edges, and refines around them where they break the bound.
  Result<void> insert_lines(Simplified& result) {
    if (lines_ == nullptr) return {};
    const auto start = Clock::now();
    refinement_.forget();
    pieces::Piece& piece = refinement_.piece();
    piece.aims = criterion_.aims();
    piece.is_refined = !inserts_first();
    piece.check = [this](std::uint64_t count, double share, double error) -> Result<void> {
      if (reporter_.due() && !reporter_.report("lines", share, count - refinement_.unused(), error))
        return fail(ErrorKind::kCancelled, "cancelled while inserting lines");
      return recipe_.memory.check_mesh(0, count - refinement_.unused(), share);
    };
    Work work;
    const pieces::ConstraintGoals goals{criterion_.aim(), recipe_.fits && recipe_.releases_starts,
                                        options_.run.threads};
    SCARP_RETURN_IF_ERROR(pieces::insert_constraints(piece, *lines_, goals, work));
    if (!piece.has_surface) return fail(ErrorKind::kInput, lines::kNothingInCutline);
    if (inserts_first()) result.work = work;
    result.passes.push_back(pass_of("lines", seconds_since(start), work));
    return {};
  }

  Result<void> fit_and_shape(Simplified& result) {
    if (!recipe_.removes_last) {
      SCARP_RETURN_IF_ERROR(remove_vertices(result));
    }
    auto shaped = add_for_shapes(result);
    if (!shaped || !recipe_.removes_last) return shaped;
    return remove_vertices(result);
  }

  /// Removes vertices that the bound does not need.
  Result<void> remove_vertices(Simplified& result) {
    if (!recipe_.fits || (recipe_.fits_strips && !options_.quality.shape.any())) return {};
    const auto start = Clock::now();
    refinement_.forget();
    fix_points();
    std::optional<metric::Criterion> whole;
    if (recipe_.scale.start < 1) {
      SCARP_TRY(auto&& made, metric::Criterion::make(field_, options_, raster_, recipe_.aim, recipe_.scale.factor));
      whole.emplace(std::move(made));
    }
    const metric::Criterion& criterion = whole ? *whole : criterion_;
    fit::FitOptions options = recipe_.fit;
    options.threshold = (recipe_.raises_bound ? criterion_ : criterion).aim();
    if (recipe_.raises_bound) {
      const pieces::MeshSize most = recipe_.scale.room->most();
      const std::uint64_t corners = most.vertices == fit::kNoBudget ? 0 : refinement_.unused();
      options.room = fit::Room{most.triangles, most.vertices + corners, criterion.aim()};
    }
    options.squares = recipe_.scale.squares;
    if (options.squares && options.squares->most_vertices != fit::kNoBudget)
      options.squares->most_vertices += refinement_.unused();
    refinement_.piece().aims = criterion.aims();
    const auto norm = fit_norm(options_, raster_, criterion);
    if (norm) options.norm = &*norm;
    if (recipe_.is_streamed) pieces::read_windows(field_, recipe_.memory, options, criterion_.source_bounds());
    options.threads = fit_threads(pieces::window_bytes(options));
    const std::uint64_t windows = pieces::window_bytes(options) * static_cast<unsigned>(options.threads);
    SCARP_RETURN_IF_ERROR(recipe_.memory.check_mesh(windows, refinement_.vertices(), 1));
    Reporter reporter(options_.run.progress);
    if (options_.run.progress) {
      options.progress = [&](double share, std::uint64_t vertices) {
        return !reporter.due() || reporter.report("fit", share, vertices, 0);
      };
    }
    SCARP_TRY(const auto& fitted, pieces::fit_piece(refinement_.piece(), std::move(options)));
    note_vertices(result);
    result.is_cut_short = fitted.is_cut_short;
    result.passes.push_back(pass_of("fit", seconds_since(start)));
    result.passes.back().removals = fitted.removed;
    return {};
  }

  /// Adds vertices for angles and sizes of triangles, and those that the bound then needs.
  Result<void> add_for_shapes(Simplified& result) {
    if (!options_.quality.shape.any()) return {};
    const auto start = Clock::now();
    refinement_.forget();
    shape::ShapeTask task{options_.quality.shape, field_.frame.affine, criterion_.aim(), criterion_.aims()};
    task.all_may_go = recipe_.releases_starts;
    std::uint64_t rows = 0;
    if (recipe_.is_streamed) {
      task.field = &field_;
      task.source_bounds = criterion_.source_bounds();
      task.rows_at_once = pieces::rows_at_once(field_, recipe_.memory, task.source_bounds);
      rows = pieces::bytes_at_once(field_, recipe_.memory, task.source_bounds);
    }
    const auto before = static_cast<double>(refinement_.piece().tin.vertex_count());
    task.progress = [&](double share, std::uint64_t count, double error) -> Result<void> {
      if (reporter_.due() && !reporter_.report("shape", 0, count, error))
        return fail(ErrorKind::kCancelled, "cancelled while refining shapes");
      const auto now = static_cast<double>(count);
      return recipe_.memory.check_mesh(rows, count, now / (before + (now - before) / share));
    };
    task.foresee = [&](double triangles) { return shape::check_need(triangles, recipe_.memory, rows); };
    SCARP_TRY(const auto& work,
              shape::refine_shapes(raster_, refinement_.piece().tin, refinement_.piece().lattice, task));
    note_vertices(result);
    result.passes.push_back(
        {"shape", seconds_since(start), work.samples_scanned, work.triangles_scanned, work.insertions});
    return {};
  }

  /// Records the kind of the vertices after fitting.
  void note_vertices(Simplified& result) {
    exact_ = recipe_.is_exact;
    if (recipe_.frees_vertices && !refinement_.piece().lattice.are_samples()) result.vertices = Vertices::kFree;
  }

  /// The number of threads for which the memory has room, each with a window of samples.
  int fit_threads(std::uint64_t window) const {
    const int threads = thread_count(options_.run.threads);
    if (!recipe_.memory.is_limited()) return threads;
    const std::uint64_t vertices = refinement_.piece().tin.vertex_count(), taken = recipe_.memory.per_vertex * vertices;
    const std::uint64_t most =
        (std::max(recipe_.memory.rest(), taken) - taken) / (fit::kFitBytesPerVertexAndThread * vertices + window);
    return static_cast<int>(std::clamp<std::uint64_t>(most, 1, static_cast<std::uint64_t>(threads)));
  }

  /// The field as used by refinement; in space, the field as given.
  HeightField clean_field() const {
    HeightField clean = field_;
    if (!recipe_.is_streamed && !field_.frame.space) clean.samples = raster_.samples;
    return clean;
  }

  void order(Simplified& result) const {
    const auto start = Clock::now();
    optimize_order(result.mesh, options_.run.threads);
    result.passes.push_back(pass_of("order", seconds_since(start)));
    result.seconds_refine += seconds_since(start);
  }

  /// Makes the mesh. The last call also releases the workbench's memory and sorts the mesh, unless the mesh is useless.
  void freeze_into(Simplified& result, bool is_last) {
    const auto start = Clock::now();
    if (!refinement_.is_whole() && !recipe_.has_lines)
      result.outline_triangles = tin::count_border_triangles(refinement_.piece().tin);
    const HeightField clean = clean_field();
    const grid::Raster given{clean.samples, raster_.cols, raster_.rows};
    const pieces::SampleHeights heights =
        !recipe_.is_streamed ? pieces::SampleHeights(given) : pieces::SampleHeights(field_, heights_);
    const pieces::VertexPositions way{heights, refinement_.piece().lattice, field_.frame, recipe_.rounds_offsets};
    const bool has_more = pieces::has_attributes(field_, options_);
    const int threads = options_.run.threads;
    pieces::LatticePoints at;
    double seconds_of_order = 0;
    if (is_last) {
      pieces::MeltDown melting(std::move(refinement_.piece().tin), way, threads);
      if (!is_useless({melting.vertex_count(), melting.triangle_count()})) {
        const auto order_start = Clock::now();
        melting.order();
        seconds_of_order = seconds_since(order_start);
      }
      result.mesh = melting.finish();
      if (has_more) at = melting.points();
      refinement_.release();
    } else {
      result.mesh = pieces::freeze(refinement_.piece().tin, way, threads);
      if (has_more) at = pieces::frozen_points(refinement_.piece().tin, refinement_.piece().lattice);
    }
    if (recipe_.height_step > 0) pieces::round_heights(result.mesh, recipe_.height_step);
    // Normals are those of the samples as read: `clean` has the samples of a locked border on its line, which
    // neighbours do not know.
    HeightField read = options_.domain.border.is_locked ? field_ : clean;
    read.channels = criterion_.channels();
    pieces::add_attributes(read, options_, at, result.mesh);
    result.passes.push_back({"freeze", seconds_since(start) - seconds_of_order});
    if (seconds_of_order > 0) result.passes.push_back({"order", seconds_of_order});
  }

  /// Counts the triangles of an outline with tolerance 1 if the outline needs most of the mesh.
  void count_looser_outline(Simplified& result) const {
    if (options_.domain.outline_tolerance > 0 || recipe_.is_streamed || result.outline_triangles == 0) return;
    if (2 * result.outline_triangles < result.mesh.triangle_count()) return;
    const auto domain = refine::build_domain(raster_, 1, field_.frame);
    if (domain) result.outline_triangles_at_one = tin::count_border_triangles(domain->tin);
  }

  /// Searches for breaches before the mesh is sorted and its topology is judged, which needs longer. The proof handles
  /// faults that this function cannot mend.
  Result<void> mend_ahead(Simplified& result) {
    const auto start = Clock::now();
    SCARP_TRY(const auto& found, prove(recipe_, criterion_, exact_, Look::kHeights, result));
    result.seconds_measure += seconds_since(start);
    result.passes.push_back(pass_of("prove", seconds_since(start)));
    if (found.kept) return {};
    const auto again = Clock::now();
    SCARP_TRY(const auto& mended, refinement_.mend(found.offenders, result));
    if (!mended) return {};
    result.passes.push_back(pass_of("refine", seconds_since(again)));
    freeze_into(result, false);
    result.seconds_refine += seconds_since(again);
    return {};
  }

  /// Judges the mesh as it will be written. If float32 positions or the frame's curvature break the bound or fold the
  /// mesh in space, the samples at fault are inserted and refinement continues.
  Result<void> prove_and_mend(Simplified& result) {
    for (;;) {
      const auto start = Clock::now();
      SCARP_TRY(const auto& proof, prove(recipe_, criterion_, exact_, Look::kAll, result));
      result.seconds_measure += seconds_since(start);
      result.passes.push_back(pass_of("prove", seconds_since(start)));
      const bool is_sound = exact_ || result.measurement.is_sound();
      // In space, a split of a fold's longest edge removes the fold.
      const bool may_unfold = field_.frame.space && result.measurement.down_facing > 0 && !proof.offenders.empty();
      if (!is_sound && !may_unfold)
        return fail(ErrorKind::kPromise,
                    "the mesh folds over itself: in this frame positions are rounded to float32, or edges are straight "
                    "where the grid's are curved; ask for a smaller error, or write in the local or grid frame");
      if (proof.kept && is_sound) return {};
      if (!refinement_.has_piece()) return fail(exact_ ? ErrorKind::kInternal : ErrorKind::kPromise, proof.broken);
      const auto again = Clock::now();
      SCARP_TRY(const auto& mended, refinement_.mend(proof.offenders, result));
      if (!mended)
        return fail(ErrorKind::kPromise,
                    (proof.kept ? "the mesh folds over itself" : proof.broken) +
                        (recipe_.rounds_offsets
                             ? ": positions in the mesh are rounded to float32, which alone costs that much; ask for a "
                               "larger error, or write OBJ or PLY, whose positions are double, or use the local or "
                               "grid frame"
                             : ": positions in the mesh are rounded to double, which alone costs that much; ask for a "
                               "larger error, or use the local or grid frame"));
      result.passes.push_back(pass_of("refine", seconds_since(again)));
      freeze_into(result, false);
      result.seconds_refine += seconds_since(again);
      order(result);
    }
  }

  const pieces::Recipe& recipe_;
  const HeightField& field_;
  const grid::Raster& raster_;
  const metric::Request& options_;
  const metric::Criterion& criterion_;
  const lines::ConstraintGraph* lines_;
  std::vector<float> heights_;  // heights of the domain's vertices, if the field has a source
  bool exact_;                  // every vertex can lie exactly on its sample, or on the lattice of fitting
  Reporter reporter_;
  GoalRefinement refinement_;  // releases its piece after its last use
};

}  // namespace

Result<Simplified> run_passes(const pieces::Recipe& recipe, const grid::Raster& raster,
                              const metric::Criterion& criterion, const lines::ConstraintGraph* lines,
                              std::optional<pieces::Tiled> tiled, std::span<const Point> border) {
  return MeshPasses(recipe, raster, criterion, lines, border).execute(std::move(tiled));
}

}  // namespace scarp::run
