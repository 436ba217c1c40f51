// Make the mesh of a height field, with the proof of its error: the main job. Also levels of detail, max errors for
// given sizes, and a mesh that grows vertex by vertex.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(const auto& made, scarp::simplify(dem, {.max_error = 20}));
//     std::printf("%zu triangles, max error %g\n", made.mesh.triangle_count(), made.measurement.max_error);
//     SCARP_RETURN_IF_ERROR(scarp::write_mesh(made.mesh, "simplified.glb"));
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A pass of simplify() and what it cost.
struct Pass {
  std::string_view name;  ///< "search"; "arrange"; "tiles", "seams"; "domain", "refine"; "lines"; "fit"; "shape";
                          ///< "freeze", "order", "prove"
  double seconds = 0;     ///< wall clock
  std::uint64_t samples_scanned = 0, triangles_scanned = 0, insertions = 0, removals = 0;
};

/// Why Effort::kAuto became Effort::kFast.
enum class WhyFast {
  kNone,      ///< it did not
  kOrder,     ///< Order::kGreedy was asked for: the paper's algorithm, which only inserts
  kStrategy,  ///< simplify_by_paper()
  kMemory,    ///< removal needs more than the memory limit allows
  kBudget,    ///< for the budget, no mesh of normal effort was better than that of insertion
};

struct Simplified {
  Mesh mesh;
  StopReason stop = StopReason::kMaxError;
  /// The proof: `mesh` as it stands, judged against all samples by measure(). The topology part is omitted in affine
  /// frames whose offsets are exact (offsets_are_exact()) or double: there it holds by construction.
  Measurement measurement;
  std::uint64_t ignored = 0;      ///< valid samples without a bound: ignored, by weight 0, by infinite tolerance
  double weighted_max_error = 0;  ///< largest weight · |error| (with a mask), |error| / tolerance (with tolerances)
  double weighted_rmse = 0;       ///< root of the mean square of the same
  /// The quantity that a budget search minimises over all samples with a bound: |error|, the norm with channels, weight
  /// · |error| with a mask; with tolerances (|error| + field.sample_rounding) / min(tolerance, max_error).
  double judged_max_error = 0;
  double judged_rmse = 0;  ///< root of the mean square of the same
  /// With tolerances: times this, all bounds hold, max_error too. 1 where they hold as they are; else what the search
  /// found, or the largest judged error of insertion that a budget stopped (+infinity: a tolerance of 0 is not kept).
  double tolerance_factor = 1;
  std::vector<Measurement> channel_measurements;  ///< one for each channel, in its own units; without topology
  double combined_max_error = 0;                  ///< with channels: the largest norm
  double combined_rmse = 0;                       ///< root of the mean square of the same
  Work work;                                      ///< counters of the engine
  Order order = Order::kGreedy;                   ///< the order that was used, never kAuto
  Effort effort = Effort::kFast;                  ///< the effort that was made, never kAuto
  WhyFast why_fast = WhyFast::kNone;              ///< why `effort` is kFast where kAuto was asked for
  Vertices vertices = Vertices::kSamples;         ///< positions of the vertices, never kAuto
  bool is_cut_short = false;                      ///< by Run::is_time_up or is_enough
  std::vector<SampleEdit> edits;                  ///< by breaklines, in raster order
  FittedFeatures features;                        ///< the lines of the mesh
  std::uint64_t lines_inserted = 0;               ///< breaklines of which some part lies in the raster
  FarthestLine farthest_line;                     ///< farthest of the breaklines with heights of their own
  /// The max error that lines were inserted for, given or found; without one, tolerance_factor times the largest
  /// tolerance that is finite.
  double lines_for = 0;
  /// Triangles needed by the outline of the valid data alone, as simplified by Domain::outline_tolerance. 0 where every
  /// sample is valid, and with lines or a cutline.
  std::uint64_t outline_triangles = 0;
  /// The value of outline_triangles at an outline tolerance of one sample. 0 where that tolerance is not 0, where
  /// outline_triangles is less than half of the mesh, and where samples are streamed.
  std::uint64_t outline_triangles_at_one = 0;
  std::uint64_t cut_off = 0;         ///< valid samples outside the cutline
  std::optional<ShapeReport> shape;  ///< shape of `mesh`, where Quality::shape asks for it
  std::vector<Pass> passes;          ///< in the order in which they ended
  double seconds_refine = 0;         ///< outline, refinement and freezing
  double seconds_measure = 0;        ///< the proof
};

/// Insertion of the worst samples (Garland & Heckbert 1995) into a constrained Delaunay triangulation of the valid
/// data.
///
/// Order: towards an error goal the locally dominant order works tile by tile, on all threads; where two tiles meet, an
/// edge that is not Delaunay is kept if the bound needs it. Budgets, and all that simplify_by_paper() offers, keep the
/// greedy order (Algorithm III), which is one thread's work. The promise is the same.
///
/// Effort: kNormal then removes each vertex whose place the vertices around it can fill. It considers all
/// triangulations of the ring around the vertex and uses the one with the least squared error; the cheapest vertices go
/// first. Once, vertices move to better samples in between. The vertices that remain are samples with their own
/// heights, and none can be removed alone. kHigh continues with rings that the bound forbids: it flips edges and moves
/// vertices around them, or undoes all of it. Vertices that are free keep max_error on the lattice they move on; where
/// float32 positions cannot hold that exactly they aim 0.2 % below it, and should rounding break it yet, the run is
/// made again with vertices on samples, unless kFree was asked. With channels vertices stay on samples, with their
/// values, and the norm is what every effort keeps.
///
/// Guarantees, for every input:
/// (1) if max_error is given and no budget ended the run, every valid sample of the domain is covered and lies within
///     max_error − field.sample_rounding of `mesh`, positions as they are in it. Where offsets_are_exact() this holds
///     in exact arithmetic; else as far as measure()'s double arithmetic sees (10⁻¹² of the largest height);
/// (2) the domain is the union of grid cells whose corners are all valid, and of half cells where three are;
/// (3) vertices are samples, but where Simplified::vertices is kFree, on lines, and where shapes were asked for;
///     triangles are counter-clockwise from above and share whole edges;
/// (4) the result depends on the field and the options only, not on threads or machine.
///
/// With channels, max_error bounds the norm of HeightField::channels instead (so the heights too where height_scale is
/// at least 1), whatever the effort, and objectives are those of the norm; with a mask it bounds the weighted error;
/// every tolerance is kept. In frames that are not exact these
/// are proven to a float32's rounding (2⁻²², and 2⁻²⁴ more a channel). Samples that are `ignored` have no bound.
///
/// Budgets are upper bounds. With more than fast effort they are met by a search for the max error whose mesh uses 99 %
/// of them, 97 % where that would be slow, mostly in two or three runs of that effort after a greedy one; less where
/// triangles jump because many samples share an error. The quantity of the objective is never larger than in the greedy
/// mesh for the same budgets. A max_error that fits is a goal of its own, and so is 0 where all samples fit (kExact).
/// With lines or shapes, in the dominant order, and where the field has a source, so does fast effort.
///
/// Objective::kRms has no search: a refined mesh of four times the triangles is reduced to the budget by the rise of
/// the squared error, its vertices move, go and come while that falls (Lindstrom and Turk's aim, on the height field's
/// own vertical error), and no sample exceeds the cap: max_error if the budget has room for it, else what fast effort
/// reaches with the budget. All of the budget is used, even where less would keep max_error. Where the field has a
/// source, with goals for shapes and with a locked border it is the search above, that keeps the least RMSE it has
/// seen.
///
/// Tolerances with a budget: if they fit, with max_error if that is given, they are the goal that ends the run
/// (StopReason::kMaxError). Else one factor above 1 is searched for that multiplies them all, and max_error; a
/// tolerance of 0 stays 0. The quantity minimised is the largest |error| / tolerance, or with Objective::kRms its RMS
/// over all samples that have one, and |error| <= Simplified::tolerance_factor · tolerance holds at every valid sample.
/// A mask divides the max error that is searched for by its weights. Ignored samples count in neither.
///
/// Memory: at most 5 bytes a sample (the caller's included) plus 120 bytes a vertex and some
/// 20 MB. In the dominant order it is 4.6 bytes a sample plus 72 a vertex until the mesh is frozen, and a tile's
/// samples, 1 to 17 MB, for each thread; ordering and the proof need the 120. More than fast effort needs 200, and 6 a
/// thread, for each vertex of the refined mesh, of which about half or two thirds then go. With a mask, tolerances, a
/// feature or a script that ignores, up to 16 more a sample; with channels 8 more a sample, and 4 a vertex and channel;
/// with one pass 16 more a sample; with data-dependent edges about 300 more a vertex. Up to 32 MiB of work buffers stay
/// in the process for later calls, on any thread: a second call on a small raster asks the system for next to nothing.
///
/// A locked border (Border) is on the mesh as it is on its own; every effort keeps it, and max_error holds for its
/// samples, too. Budgets must have room for it. It needs max_error or tolerances, and 4 bytes a sample more.
///
/// Strategies (simplify_by_paper()) change which samples become vertices, never what is promised.
///
/// Fails with kUsage (no goal, an ignored sample or a point outside the raster, settings with a conflict
/// (list_conflicts()), a mask, tolerance or channel out of range, a goal out of range, a budget below what the outline
/// needs), kMemory (a memory limit that cannot be kept), kInput (fewer than 2×2 samples, no valid cell), kPromise (a
/// bound that float32 positions or samples cannot keep, a mesh that rounding or a projection folds over), kCancelled.
Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& options);
/// The same towards goals alone: `simplify(field, {.max_error = 1.5})`.
Result<Simplified> simplify(const HeightField& field, const Goals& goals);

/// The same engine, one vertex at a time, by heights alone: channels are ignored, and a frame in space counts by the
/// heights above the tangent plane at its centre. Works on a copy of nothing: the samples must stay alive.
class Refiner {
 public:
  /// Builds the triangulation of the outline and finds every triangle's worst sample.
  static Result<Refiner> create(const HeightField& field, double outline_tolerance = 0);
  Refiner(Refiner&&) noexcept;
  Refiner& operator=(Refiner&&) noexcept;
  ~Refiner();

  /// Inserts the sample with the largest error (ties: lowest row, then lowest column). Returns false, without change,
  /// once every sample is reproduced exactly. Cost: expected O(log vertices + samples rescanned).
  bool insert_worst();
  /// Largest error of the current mesh over all samples; 0 if none is left.
  double max_error() const;
  std::uint64_t vertex_count() const;
  std::uint64_t triangle_count() const;
  /// The current mesh, in the field's frame. `float32_positions`: rounded as for writing, so that its own error may be
  /// larger than max_error() where float32 does not hold the offsets of x and y.
  Mesh mesh(bool float32_positions = true) const;

 private:
  struct Impl;
  explicit Refiner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Levels of detail: meshes of one raster that replace each other.

struct Levels {
  int count = 1;     ///< 1 to 32
  double ratio = 2;  ///< ratio of the max error of a level to that of the next finer one, above 1
};

/// The meshes for max errors E, ratio · E, ratio² · E …, the finest first; E is the max error of `options`. Each is
/// simplified from the full raster, and proven for its own max error. All have one outline, a locked border (Border)
/// for the max error E, or as `options` have it: where one level replaces another, no gap opens to whatever meets the
/// raster's edge. Each level has the affine map and the origin of the others.
///
/// Cost: that of as many runs; coarse ones are faster. Fails as simplify() does; with kUsage for a count or a ratio out
/// of range, without a max error, and for what does not go with levels (docs/conflicts.md).
Result<std::vector<Simplified>> simplify_levels(const HeightField& field, const SimplifyOptions& options,
                                                const Levels& levels);

// The max error for a mesh of a given size.

/// A max error for a share of the triangles.
struct Suggestion {
  double share = 0;             ///< share of the full grid's triangles, above 0, at most 1
  std::optional<double> error;  ///< max error, in z units: a default run with it stays within the share, and may use
                                ///< far less of it. Three significant digits. None: the outline alone needs more.
};

struct Suggestions {
  std::vector<Suggestion> rows;    ///< one a share, in the order of the shares
  bool is_estimate = false;        ///< made from windows of the raster, not from all of it
  std::uint64_t samples_used = 0;  ///< samples of these windows, or of the raster
};

/// Suggests a max error for each share. The engine first runs greedily on the field until the last share is used up. It
/// then runs in the default order with the errors found, on all threads, and again with larger errors where a run needs
/// more triangles. For fields of more than 2 million samples it uses up to 16 evenly spaced windows of 256 × 256
/// samples, refined as one: the window with the largest error gets the next vertex. Windows have more border for their
/// area than the raster, so the estimate is a little too large. The result depends on the samples and the shares only.
///
/// The field is borrowed during the call. Its channels are omitted: errors are those of heights.
/// `progress`: of the pass "estimate"; may be empty.
/// Fails with kUsage for no shares, for shares not above 0, above 1 or not ascending, and for a field without samples
/// in memory; with kInput if no cell is valid; with kCancelled. Memory: as a greedy run and a default run of simplify()
/// on the samples used. Cost: some two default runs on the samples used, and one a share.
Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
