// From a height field to the mesh: the main job.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/cutline.h"
#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/progress.h"
#include "scarp/result.h"
#include "scarp/shape.h"
#include "scarp/strategy.h"

#pragma GCC visibility push(default)

namespace scarp {

/// What to reach. At least one goal; the first that is reached ends the run. What does not go together: conflicts.h.
struct SimplifyOptions {
  /// Vertical error bound in z units, at least 0: |mesh − sample| <= max_error at every valid sample. 0 reproduces
  /// every sample. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds. If one of them ends the run, the result is the mesh with the smallest max error among those with at
  /// least 95 % of the budget (max error is not monotone in the number of points); with more than fast effort what the
  /// search for an error has found (see "Budgets"). DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// How far, in samples, the outline of the valid data may be simplified, at least 0. It only moves outwards, over
  /// void samples: no valid sample is cut off. DEFAULT: 0, the exact outline.
  double outline_tolerance = 0;
  /// Round positions to float32, as GLB and STL hold them, so that what is proven is what is written. False: positions
  /// are double, as OBJ and PLY hold them, and vertices lie on their samples in every affine frame. DEFAULT: true.
  bool float32_positions = true;

  /// Weights, one a sample, at least 0 and finite (Terra's importance mask): weight · |error| is what is ranked and
  /// what max_error bounds. Where the weight is 0 there is no bound. Borrowed. DEFAULT: empty, all 1.
  std::span<const float> mask = {};
  /// Bounds, one a sample, at least 0, in z units; +infinity: none. |error| <= tolerance at every valid sample, beside
  /// max_error if that is given; |error| / tolerance is ranked. A goal of its own. Borrowed.
  /// DEFAULT: empty.
  std::span<const float> tolerance = {};
  /// The same where the field has a source, read in windows as its samples are (no NaN): there the above fails with
  /// kUsage, as this does beside samples in memory. Borrowed. DEFAULT: none.
  const SampleSource* tolerance_source = nullptr;
  /// Breaklines. A hard line keeps its heights, a soft one follows the raster. Where a hard line passes through a
  /// sample that has another height, the sample is given the line's, and what is promised holds for the samples as they
  /// are then (Simplified::edits). Fails with kUsage without a max error or a budget, with kInput for lines whose
  /// heights contradict each other, named.
  /// With a budget an error is searched for, whatever the effort (see "Budgets"); fails with kUsage for a budget
  /// below what lines and outline need.
  /// DEFAULT: none.
  LineConstraints breaklines = {};
  /// Breaklines that depend on the max error of the mesh to come, such as rivers and the lines of cliffs: asked for all
  /// breaklines, in place of the above, before each run that a budget's search makes, or once. DEFAULT: none.
  std::function<Result<LineConstraints>(double max_error)> breaklines_for = {};
  /// Polygons that the surface is cut to: of guarantee (2)'s domain what lies in them. Their rings become edges of the
  /// mesh, moved by 1/512 sample at most (3/512 where lines cross), at the heights of the raster between its samples;
  /// they follow it to within half of max_error, all of it within a sample of their vertices. Samples outside are not
  /// judged. Fails as faults do, and with kInput where no surface lies in the polygons. DEFAULT: none.
  Cutline cutline = {};
  std::vector<ScriptStep> script = {};  ///< carried out in order before the first scan. DEFAULT: nothing.
  /// kAuto is kDominant towards an error where that order has no conflicts (conflicts.h), else kGreedy. kDominant with
  /// a budget searches for the error whose mesh fits. DEFAULT: kAuto.
  Order order = Order::kAuto;
  /// kAuto is kNormal where min_shape, is_time_up or Objective::kRms ask for more than refinement. Vertices that a
  /// script inserts stay, whatever the effort. DEFAULT: kAuto.
  Effort effort = Effort::kAuto;
  /// kFree fails with kUsage below kHigh. DEFAULT: kAuto.
  Vertices vertices = Vertices::kAuto;
  /// Floor of the shapes of triangles, height over longest edge, 0 … 0.5, 0 for none: no vertex is removed or moved, no
  /// edge flipped if that leaves a triangle below it, unless it takes away one that is as bad. Triangles of refinement,
  /// and those that the outline of voids forces, may lie below.
  /// DEFAULT: 0.1 where vertices are free, else 0.
  std::optional<double> min_shape = std::nullopt;
  /// Angles, edge lengths and their growth, for simulations: vertices are added until they hold, then removed as far as
  /// they still do (with a grade the other way round). With a budget an error is searched for, as with lines. Fails
  /// with kUsage without a max error or a budget, for goals out of range, and for a budget below what they need.
  /// DEFAULT: none.
  ShapeGoals shape = {};
  /// Asked often, on any thread, by all efforts but kFast; once true, true for good. Then vertices are no longer
  /// removed, and the mesh so far, which keeps the promise, is the result: it depends on the time. With a budget the
  /// search then ends with the best mesh so far. DEFAULT: never.
  std::function<bool()> is_time_up = {};
  /// Asked and obeyed in the same way, for somebody who stops waiting: it is no time to use up, so kMax does not go on
  /// until then. Not asked by fast effort and with a budget. DEFAULT: never.
  std::function<bool()> is_enough = {};
  /// kRms fails with kUsage without a budget. DEFAULT: kMax.
  Objective objective = Objective::kMax;
  Importance importance = {};  ///< DEFAULT: global error
  Algorithm algorithm = Algorithm::kHeap;
  Batch batch = {};        ///< DEFAULT: one at a time
  EdgeRule edges = {};     ///< DEFAULT: Delaunay
  Norm norm = Norm::kSum;  ///< over heights and channels, where the field has channels. DEFAULT: L1, as the report.
  /// False: a budget that ends the run leaves the last mesh, as Scape does, though an earlier one may have been better.
  /// DEFAULT: true. Always so where importance is not an error: one pass, products.
  bool best_of_budget = true;
  bool uvs = false;  ///< fill Mesh::uvs. DEFAULT: false.

  /// Vertex normals from the full-resolution samples. DEFAULT: false.
  bool normals = false;
  int threads = 0;  ///< 0 = all cores. Never changes the result. DEFAULT: 0.
  /// Bytes that the whole process is to stay under; 0 = no limit. Rows of tiles, threads and the file's blocks are
  /// chosen to fit it, and what cannot fit is refused: before the first tile, or as soon as the mesh outgrows it. What
  /// simplify() takes is estimated (see "Memory"), not counted. DEFAULT: 0.
  std::uint64_t memory_limit = 0;
  /// Of memory_limit, what others take: the program, the samples or the cache of their file. DEFAULT: 0.
  std::uint64_t memory_taken = 0;
  /// Bytes a vertex that the caller will take beside the mesh, to write it. DEFAULT: 80, more than GLB takes.
  std::uint64_t memory_per_vertex = 80;
  ProgressCallback progress = {};
};

/// A pass of simplify() and what it cost.
struct Pass {
  std::string_view name;  ///< "search"; "arrange"; "tiles", "seams"; "domain", "refine"; "lines"; "fit"; "shape";
                          ///< "freeze", "order", "prove"
  double seconds = 0;     ///< wall clock
  std::uint64_t samples_scanned = 0, triangles_scanned = 0, insertions = 0, removals = 0;
};

/// A sample that a breakline changed.
struct SampleEdit {
  std::int32_t col = 0, row = 0;
  float before = 0, after = 0;
};

/// Which goal ended the run.
enum class StopReason { kMaxError, kMaxTriangles, kMaxVertices, kExact };

struct Simplified {
  Mesh mesh;
  StopReason stop = StopReason::kMaxError;
  /// The proof: `mesh` as it stands, judged against all samples by measure(). The topology part is left out in affine
  /// frames whose offsets are exact (offsets_are_exact()) or double: there it holds by construction.
  Measurement measurement;
  std::uint64_t ignored = 0;      ///< valid samples without a bound: by the script, by weight 0, by infinite tolerance
  double weighted_max_error = 0;  ///< largest weight · |error| (with a mask), |error| / tolerance (with tolerances)
  double weighted_rmse = 0;       ///< root of the mean square of the same
  std::vector<Measurement> channel_measurements;  ///< of each channel, in its own units; without topology
  double combined_max_error = 0;                  ///< with channels: the largest norm
  double combined_rmse = 0;                       ///< root of the mean square of the same
  Work work;                                      ///< what the engine did
  Order order = Order::kGreedy;                   ///< the order that was taken, never kAuto
  Effort effort = Effort::kFast;                  ///< the effort that was made, never kAuto
  Vertices vertices = Vertices::kSamples;         ///< where they are, never kAuto
  bool is_cut_short = false;                      ///< by SimplifyOptions::is_time_up or is_enough
  std::vector<SampleEdit> edits;                  ///< by breaklines, in raster order
  std::uint64_t lines_laid = 0;                   ///< breaklines of which some part lies in the raster
  double lines_for = 0;                           ///< the max error that lines were laid for, given or found
  std::uint64_t cut_off = 0;                      ///< valid samples outside the cutline
  std::optional<ShapeReport> shape;               ///< of `mesh`, where SimplifyOptions::shape asks for something
  std::vector<Pass> passes;                       ///< in the order in which they ended
  double seconds_refine = 0;                      ///< outline, refinement and freezing
  double seconds_measure = 0;                     ///< the proof
};

/// Insertion of the worst samples (Garland & Heckbert 1995) into a constrained Delaunay triangulation of the valid
/// data.
///
/// Order: towards an error goal the locally dominant order works tile by tile, on all threads; where two tiles meet, an
/// edge that is not Delaunay is kept if the bound needs it. Budgets, and all that strategy.h offers, keep the greedy
/// order (Algorithm III), which is one thread's work. What is promised is the same.
///
/// Effort: kNormal then removes each vertex whose place the vertices around it can take, all triangulations of the ring
/// that it leaves considered, the one with the least squared error taken; those that cost least go first. What is left
/// are samples with their own heights, and no vertex can go alone. kHigh goes on with rings that the bound forbids: it
/// flips edges and moves vertices around them, and takes all back where that does not mend it. Vertices that are free
/// keep max_error on the lattice they move on; where float32 positions cannot hold that lattice exactly they aim 0.2 %
/// below it, and should rounding break it yet, the run is made again with vertices on samples, unless kFree was asked.
/// With channels vertices stay on samples, with their values, and the norm is what every effort keeps.
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
/// Budgets are upper bounds. With more than fast effort they are met by a search for the max error whose mesh takes 99
/// % of them, 97 % where that takes long, mostly in two or three runs of that effort after a greedy one; less where
/// triangles jump because many samples share an error. What the objective names is never larger than in the greedy mesh
/// for the same budgets. A max_error that fits is a goal of its own, and so is 0 where all samples fit (kExact). With
/// lines or shapes, in the dominant order, and where the field has a source, so does fast effort.
///
/// Memory: at most 5 bytes a sample (the caller's included) plus 120 bytes a vertex and some
/// 20 MB. In the dominant order it is 4.6 bytes a sample plus 72 a vertex until the mesh is frozen, and a tile's
/// samples, 1 to 17 MB, for each thread; ordering and the proof take the 120. More than fast effort takes 200, and 6 a
/// thread, for each vertex of the refined mesh, of which about half or two thirds then go. With a mask, tolerances, a
/// feature or a script that ignores, up to 16 more a sample; with channels 8 more a sample, and 4 a vertex and channel;
/// with one pass 16 more a sample; with data-dependent edges about 300 more a vertex. Up to 32 MiB of work buffers stay
/// in the process for later calls, on any thread: a second call on a small raster asks the system for next to nothing.
///
/// Strategies (strategy.h) change which samples become vertices, never what is promised.
///
/// Fails with kUsage (no goal, a script step outside the raster, settings with a conflict (conflicts.h), a mask,
/// tolerance or channel out of range, a goal out of range, a budget below what the outline needs, a memory_limit that
/// cannot be kept), kInput (fewer than 2×2 samples, no valid cell), kPromise (a bound that float32 positions or samples
/// cannot keep, a mesh that rounding or a projection folds over), kCancelled.
Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& options);

/// The same engine, one vertex at a time, by heights alone: channels are not looked at. Works on a copy of nothing:
/// the samples must stay alive.
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
  /// The current mesh, in the field's frame, rounded as for writing.
  Mesh mesh() const;

 private:
  struct Impl;
  explicit Refiner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scarp

#pragma GCC visibility pop
