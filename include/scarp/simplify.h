// Make the mesh of a height field, with the proof of its error. Also make levels of detail, find max errors for given
// sizes, and grow a mesh vertex by vertex.
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

/// A pass of simplify().
struct Pass {
  std::string_view name;  ///< "search"; "arrange"; "tiles", "seams"; "domain", "refine"; "lines"; "fit"; "shape";
                          ///< "freeze", "order", "prove"
  double seconds = 0;     ///< wall clock
  std::uint64_t samples_scanned = 0, triangles_scanned = 0, insertions = 0, removals = 0;
};

/// Reason why Effort::kAuto became Effort::kFast.
enum class WhyFast {
  kNone,      ///< kAuto did not become kFast
  kOrder,     ///< Order::kGreedy was requested: the paper's algorithm, which only inserts
  kStrategy,  ///< simplify_by_paper() was called
  kMemory,    ///< removal needs more than the memory limit allows
  kBudget,    ///< for the budget, normal effort found no better mesh than insertion
};

struct Simplified {
  Mesh mesh;
  StopReason stop = StopReason::kMaxError;
  /// The proof: the result of measure() for `mesh` against all samples. Topology is not measured in affine frames whose
  /// offsets are exact (offsets_are_exact()) or double: there it is correct by construction.
  Measurement measurement;
  std::uint64_t ignored = 0;      ///< valid samples without a bound: ignored, weight 0, infinite tolerance
  double weighted_max_error = 0;  ///< largest weight · |error| (with a mask), |error| / tolerance (with tolerances)
  double weighted_rmse = 0;       ///< RMS of the same quantity
  /// The largest value, over all samples with a bound, of the quantity that a budget search minimises: |error|; with
  /// channels the norm; with a mask weight · |error|; with tolerances (|error| + field.sample_rounding) /
  /// min(tolerance, max_error).
  double judged_max_error = 0;
  double judged_rmse = 0;  ///< RMS of the same quantity
  /// All tolerances, and max_error, hold when multiplied by this factor. 1 if they hold unchanged; else the factor
  /// found by the search or, if a budget stopped insertion, the largest judged error (+infinity: a tolerance of 0 is
  /// exceeded).
  double tolerance_factor = 1;
  std::vector<Measurement> channel_measurements;  ///< one for each channel, in its own units; without topology
  double combined_max_error = 0;                  ///< with channels: the largest norm
  double combined_rmse = 0;                       ///< RMS of the same quantity
  Work work;                                      ///< counters of the engine
  Order order = Order::kGreedy;                   ///< the order that was used, never kAuto
  Effort effort = Effort::kFast;                  ///< the effort that was used, never kAuto
  WhyFast why_fast = WhyFast::kNone;              ///< reason for kFast where kAuto was requested
  Vertices vertices = Vertices::kSamples;         ///< positions of the vertices, never kAuto
  bool is_cut_short = false;                      ///< Run::is_time_up or is_enough ended the run early
  std::vector<SampleEdit> edits;                  ///< samples changed by breaklines, in raster order
  FittedFeatures features;                        ///< the lines of the mesh
  std::uint64_t lines_inserted = 0;               ///< breaklines at least partly in the raster
  FarthestLine farthest_line;                     ///< the hard breakline farthest above or below the raster
  /// The max error, given or found, for which lines were inserted; without a max error, tolerance_factor times the
  /// largest finite tolerance.
  double lines_for = 0;
  /// Number of triangles that the outline of the valid data needs, after simplification by Domain::outline_tolerance. 0
  /// if every sample is valid, and with lines or a cutline.
  std::uint64_t outline_triangles = 0;
  /// The value of outline_triangles at an outline tolerance of one sample. 0 where Domain::outline_tolerance is not 0,
  /// where outline_triangles is less than half of the mesh, and where samples are streamed.
  std::uint64_t outline_triangles_at_one = 0;
  std::uint64_t cut_off = 0;         ///< valid samples outside the cutline
  std::optional<ShapeReport> shape;  ///< triangle shapes of `mesh`, if Quality::shape sets goals
  std::vector<Pass> passes;          ///< in the order in which they ended
  double seconds_refine = 0;         ///< outline, refinement and freezing
  double seconds_measure = 0;        ///< the proof
};

/// Inserts the worst samples (Garland & Heckbert 1995) into a constrained Delaunay triangulation of the valid data.
///
/// Order: with an error goal, simplify() refines tile by tile, in the locally dominant order, on all threads. Where two
/// tiles meet, an edge that is not Delaunay is kept if the bound needs it. Budgets and simplify_by_paper() use the
/// greedy order (Algorithm III), on one thread. The guarantees are the same.
///
/// Effort: after refinement, kNormal removes each vertex that the bound does not need. It considers all triangulations
/// of the ring around the vertex and uses the one with the least squared error. The cheapest vertices are removed
/// first. Once during removal, vertices move to better samples. In the end, all vertices are samples with their own
/// heights, and no single vertex can be removed. kHigh also tries removals that break the bound. It then repairs the
/// bound by flipping edges and moving nearby vertices, or undoes the removal. Free vertices satisfy max_error at their
/// lattice positions. Where float32 cannot hold these exactly, the engine uses a bound 0.2 % below max_error. If
/// rounding still breaks the bound, the run is repeated with vertices on samples, unless kFree was requested. With
/// channels, vertices remain samples with their own values, and every effort bounds the norm.
///
/// Guarantees, for every input:
/// (1) if max_error is given and no budget ended the run, every valid sample of the domain is covered and lies within
///     max_error − field.sample_rounding of `mesh` at its stored positions. If offsets_are_exact(), this holds in exact
///     arithmetic; else to the precision of measure()'s double arithmetic (10⁻¹² of the largest height);
/// (2) the domain is the union of grid cells with four valid corners, and of half of each cell with three;
/// (3) vertices are samples, except on lines, with shape goals, and where Simplified::vertices is kFree; triangles are
///     counter-clockwise from above and share whole edges;
/// (4) the result depends on the field and the options only, not on threads or machine.
///
/// With channels, max_error bounds the norm of HeightField::channels at every effort (and so height errors, if
/// height_scale is at least 1), and objectives refer to the norm. With a mask, max_error bounds the weighted error.
/// Every tolerance is satisfied. In frames with inexact offsets, these bounds are proven up to float32 rounding (2⁻²²,
/// plus 2⁻²⁴ a channel). `ignored` samples have no bound.
///
/// Budgets are upper bounds. With more than fast effort, a search finds the max error whose mesh uses 99 % of the
/// budget (97 % where 99 % would be slow). The search usually needs two or three runs of that effort after a greedy
/// run. The mesh uses less of the budget if the triangle count jumps because many samples share an error. The objective
/// is never larger than in the greedy mesh for the same budget. A max_error that fits the budget ends the run, as does
/// an error of 0 (kExact). Fast effort also uses this search with lines or shapes, in the dominant order, and if the
/// field has a source.
///
/// With Objective::kRms there is no search. simplify() refines a mesh of four times the allowed triangles, then removes
/// the vertices whose removal raises the squared error least, until the mesh fits the budget. Then vertices are moved,
/// removed and inserted while the squared error falls (Lindstrom and Turk's objective, for vertical errors). No error
/// exceeds a cap: max_error if it fits the budget, else the max error that fast effort reaches for the budget. The
/// whole budget is used, even if fewer triangles would satisfy max_error. With a source, shape goals or a locked
/// border, the search above runs instead and returns the mesh of least RMSE.
///
/// Tolerances with a budget: if the tolerances (and max_error, if given) fit the budget, they end the run
/// (StopReason::kMaxError). Otherwise the search scales all tolerances and max_error by one factor above 1; a tolerance
/// of 0 stays 0. It minimises the largest |error| / tolerance or, with Objective::kRms, the RMS of this ratio over all
/// samples with a tolerance. |error| <= Simplified::tolerance_factor · tolerance holds at every valid sample. With a
/// mask, the search divides its error by the weight of each sample. Ignored samples do not count.
///
/// Memory: at most 5 bytes a sample (including the caller's samples) plus 120 bytes a vertex and some 20 MB. In the
/// dominant order: 4.6 bytes a sample, 72 a vertex until the mesh is frozen (120 for ordering and the proof), and a
/// tile's samples, 1 to 17 MB, for each thread. More than fast effort needs 200 bytes, and 6 a thread, for each vertex
/// of the refined mesh; it removes about half to two thirds of these vertices. Masks, tolerances, features and ignored
/// samples add at most 16 bytes a sample. Channels add 8 a sample, and 4 a vertex and channel; one pass adds 16 a
/// sample; data-dependent edges add about 300 a vertex. Up to 32 MiB of work buffers stay in the process for later
/// calls on any thread, so a second call on a small raster allocates almost nothing.
///
/// A locked border (Border) does not depend on the rest of the mesh. Every effort preserves it, and max_error holds at
/// its samples too. The border must fit the budget. It needs max_error or tolerances, and 4 more bytes a sample.
///
/// Strategies (simplify_by_paper()) change the choice of vertices, never the guarantees.
///
/// Fails with kUsage for no goal; an ignored sample or a point outside the raster; conflicting settings
/// (list_conflicts()); a mask, tolerance, channel or goal out of range; a budget too small for the outline. Fails with
/// kMemory if the memory limit is too small, with kInput for fewer than 2×2 samples or no valid cell, with kPromise for
/// a bound that float32 positions or samples cannot satisfy, or a mesh folded by rounding or projection, and with
/// kCancelled.
Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& options);
/// The same with goals only: `simplify(field, {.max_error = 1.5})`.
Result<Simplified> simplify(const HeightField& field, const Goals& goals);

/// The engine of simplify(), one vertex at a time, for heights only: channels are ignored. In a frame in space, heights
/// are those above the tangent plane at the raster's centre. The samples are borrowed and must stay alive.
class Refiner {
 public:
  /// Builds the triangulation of the outline and finds every triangle's worst sample.
  static Result<Refiner> create(const HeightField& field, double outline_tolerance = 0);
  Refiner(Refiner&&) noexcept;
  Refiner& operator=(Refiner&&) noexcept;
  ~Refiner();

  /// Inserts the sample with the largest error (ties: lowest row, then lowest column). Returns false, without a change,
  /// once every sample is reproduced exactly. Cost: expected O(log vertices + samples rescanned).
  bool insert_worst();
  /// Largest error of the current mesh over all samples; 0 if it is exact.
  double max_error() const;
  std::uint64_t vertex_count() const;
  std::uint64_t triangle_count() const;
  /// The current mesh, in the field's frame. `float32_positions`: rounds positions as for writing. The mesh's error may
  /// then exceed max_error() if float32 cannot hold the offsets of x and y.
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

/// Makes the meshes for max errors E, ratio · E, ratio² · E …, the finest first; E is the max error of `options`. Each
/// mesh is simplified from the full raster, and proven for its own max error. All share one outline: a locked border
/// (Border) for the max error E, or the border of `options`. So a level that replaces another opens no gap at the
/// raster's edge. All levels share the affine map and the origin.
///
/// Cost: one run for each level; coarse levels are faster. Fails as simplify() does, and with kUsage for a count or a
/// ratio out of range, without a max error, and for settings in conflict with levels (docs/conflicts.md).
Result<std::vector<Simplified>> simplify_levels(const HeightField& field, const SimplifyOptions& options,
                                                const Levels& levels);

// The max error for a mesh of a given size.

struct Suggestion {
  double share = 0;             ///< share of the full grid's triangles, above 0, at most 1
  std::optional<double> error;  ///< max error in z units, with three significant digits. A default run with this
                                ///< error stays within the share; it may use far less. None if the outline needs
                                ///< more triangles.
};

struct Suggestions {
  std::vector<Suggestion> rows;    ///< one for each share, in their order
  bool is_estimate = false;        ///< computed from windows of the raster only
  std::uint64_t samples_used = 0;  ///< samples of these windows, or of the raster
};

/// Suggests a max error for each share. The engine first runs greedily on the field until it reaches the last share. It
/// then runs in the default order with the errors found, on all threads, and repeats a run with a larger error if the
/// mesh exceeds its share. For fields of more than 2 million samples, the engine uses up to 16 evenly spaced windows of
/// 256 × 256 samples, refined as one: the window with the largest error gets the next vertex. Windows have more border
/// relative to their area than the raster, so the estimate is a little too large. The result depends on the samples and
/// the shares only.
///
/// The field is borrowed during the call. Channels are ignored: errors are those of heights. `progress` receives the
/// pass "estimate"; it may be empty. Fails with kUsage for no shares, for shares outside (0, 1] or not ascending, and
/// for a field without samples in memory; with kInput if no cell is valid; with kCancelled. Memory: that of a greedy
/// run and a default run of simplify() on the samples used. Cost: about two default runs on the samples used, and one
/// for each share.
Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
