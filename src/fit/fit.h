// The interface of fitting, which makes a mesh smaller while it satisfies the same bound.
//
// The mesh is cut into patches (cut.h), and each patch is reduced independently (removal.h). A second removal, in
// squares shifted by half, reaches the vertices along the first borders. Optional rounds of removal with repair
// (schedule.h) follow. Their squares grow as triangles become fewer, and every second round shifts them. A last round
// handles vertices near earlier borders, and polishes heights. Patches depend on the mesh only, so the result is the
// same on any number of threads.
//
// Compared with a single patch, kHighDepth in patches ends with 98.9 to 100.6 % of the triangles (32 cases: eight
// rasters, 2 to 0.2 % of the relief). With fixed squares and without the last round, the share was 101.1 to 101.3 % on
// a raster of 1197 x 643 samples. The last round needs some 3 % of the time.
//
// If there is time left, rounds continue. Repair soon finds nothing more, so each of these rounds first moves all
// vertices a little, within the bound. At 1 % of the relief, with shapes of at least a tenth, effort max ends with
// 0.237 of greedy's triangles on Fuji and 0.263 on Crater Lake. With five to six times the time, it ends with 0.230 and
// 0.254.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "fit/cut.h"
#include "fit/fit_norm.h"
#include "fit/repair.h"
#include "fit/rules.h"
#include "fit/sample_window.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp::fit {

struct FitDepth {
  /// After the first removal each vertex moves to a better sample, and removal continues (relocation.h).
  bool relocates = false;
  int rounds = 0;  ///< rounds of removal with repair (schedule.h)
  RepairDepth repair = {};
  int polishes = 0;  ///< final sweeps that lower the squared error
};

inline constexpr FitDepth kNormalDepth{true};
/// bench/quality/efforts.csv lists the share of greedy's triangles and the time for each depth.
inline constexpr FitDepth kHighDepth{true, 2, {10, 3, false, true}, 9};
inline constexpr FitDepth kMaxDepth{true, 3, {10, 3, true, true, true, 4, 0.03}, 9};

inline constexpr std::uint64_t kNoBudget = std::numeric_limits<std::uint64_t>::max();

/// Budgets of triangles and vertices that a mesh shall fit into.
struct Room {
  std::uint64_t most_triangles = kNoBudget, most_vertices = kNoBudget;
  double highest = 0;  ///< the largest acceptable threshold
};

/// A budget of triangles or vertices, within which the squared error is reduced (square_rounds.h).
struct SquareGoal {
  std::uint64_t most_triangles = kNoBudget, most_vertices = kNoBudget;
  int exchanges = 6;
};

struct FitOptions {
  double threshold = 0;
  /// The threshold rises in small steps until the mesh is within these budgets, and removal continues after each.
  /// DEFAULT: none, the threshold stays. REQUIRES: no bounds of samples; a threshold above 0.
  std::optional<Room> room = std::nullopt;
  /// A bound for each sample, row-major like the raster: at least 0, +infinity for none, no NaN. The bounds replace the
  /// threshold, and energies use the ratio of error to bound. EMPTY: the threshold applies to all samples.
  std::span<const float> bounds = {};
  /// Scattered samples instead of the raster's; they must outlive the call. The raster then has only a size, in cells
  /// of kLatticeSteps; vertices lie on the lattice and have their own heights. DEFAULT: null, the raster's samples.
  const ScatteredSamples* points = nullptr;
  /// Errors are norms over several fields. Then vertices stay on samples, and heights have no separate bound. Must
  /// outlive the call. DEFAULT: null, errors of heights only.
  const FitNorm* norm = nullptr;
  int threads = 0;
  /// Sides must keep their vertices if they are curved in the mesh's frame or shared with other meshes.
  FreeSides free_sides = {};
  /// With relocation or rounds, vertices move to other samples.
  FitDepth depth = {};
  /// Floor of the shapes of triangles, 2·area over the longest edge squared (rules.h); 0: none. A floor of a tenth
  /// costs 2 to 6 % more triangles and saves time. The input mesh may have thinner triangles; no move makes the worst
  /// one worse.
  double min_shape = 0;
  /// The floor does not apply to removal, nor to repair of patches where more than kThinShare of the triangles are
  /// below it after removal. In such patches, long thin triangles suit the heights.
  bool floor_yields = false;
  double aspect = 1;  ///< size of a sample in y over its size in x; shapes are computed with it
  /// Replaces min_shape and aspect: rules on angles and edge lengths. DEFAULT: none.
  std::optional<ShapeRule> shape = std::nullopt;
  /// Repair may place vertices between samples, on the lattice of fitting, at heights of their own.
  bool vertices_are_free = false;
  std::int32_t patch_side = 0;  ///< in samples; 0: squares of some kPatchTriangles triangles, one square for small
                                ///< meshes
  std::int32_t most_side = 0;   ///< largest side of squares, in samples; 0: no limit
  /// Copies the samples of a window to `to`, nodata as NaN; may throw; called on any thread. DEFAULT: none, the raster
  /// has the samples.
  ReadWindow read = {};
  /// The same for the bounds of samples, instead of `bounds`. DEFAULT: none, the threshold or `bounds` apply.
  ReadWindow read_bounds = {};
  std::int64_t most_window = 0;  ///< samples; patches with larger windows stay unchanged; 0: no limit
  /// Receives the finished share of the work and the number of vertices, on the calling thread; false stops with
  /// kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
  /// Called often, on any thread. Once it returns true, it must always return true, and the rounds end with the current
  /// mesh.
  std::function<bool()> is_time_up = {};
  /// If the depth has rounds, more follow until the time is up or two in a row remove less than a thousandth of the
  /// vertices. Each of them begins with a shake of all vertices.
  bool goes_on = false;
  /// Replaces removal and rounds. DEFAULT: none.
  std::optional<SquareGoal> squares = std::nullopt;
};

/// Share of a patch's triangles. After removal, 0.03 to 0.11 of the triangles are below a floor of a tenth on natural
/// land, 0.04 to 0.15 in rasters of trees, 0.27 to 0.51 of buildings.
inline constexpr double kThinShare = 0.15;

/// A patch of this many triangles, with its samples, fits the caches of one core.
inline constexpr std::int64_t kPatchTriangles = 8192;

/// The most memory per vertex of the input mesh, including the mesh: with one thread, the sum of these two constants;
/// each further thread adds the second.
inline constexpr std::uint64_t kFitBytesPerVertex = 200;
inline constexpr std::uint64_t kFitBytesPerVertexAndThread = 6;

struct FitCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< number of rings examined
  std::uint64_t repaired = 0;  ///< number of vertices removed with repair
  std::uint64_t tried = 0;     ///< removals with repair that were tried
};

struct Fitted {
  tin::Triangulation tin;  ///< its points count in lattice.steps
  FitCounts counts;
  /// If vertices were free, this lattice has kLatticeSteps steps per sample, and heights; otherwise vertices are
  /// samples. Heights lie between the lowest and the highest valid sample of the raster, so no vertex is below a sea of
  /// height 0.
  grid::VertexLattice lattice;
  bool is_cut_short = false;  ///< because the time was up
  double threshold = 0;       ///< the last one; options.threshold unless it rose
};

/// `lattice`: the lattice of the vertices of `tin`.
///
/// Returns a triangulation of some of the vertices with the same domain and constraints. Its triangles are within the
/// threshold, or within the sample's bound, at every sample of the domain, in exact arithmetic. Vertices of the outline
/// stay, except on the sides of the rectangle. Repair may move other vertices; those on a side move only along it.
/// Triangles with heights or extents beyond kMaxScanHeight or kMaxFitSteps stay unchanged. Repair is skipped for
/// thresholds outside 2⁻⁶⁰ … 2⁶⁰. For sides longer than kMaxCoordinate / kLatticeSteps samples, it places vertices only
/// on samples. Fails with kCancelled only. REQUIRES: the triangles inside are within the threshold, by the norm's
/// find_breach if there is one, and have valid corners; threshold >= 0 and finite. Vertices are free, or the depth has
/// no rounds, or each vertex is a sample unless it is fixed or an end of a constrained edge within the rectangle.
Result<Fitted> fit(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
                   const FitOptions& options);
inline Result<Fitted> fit(const grid::Raster& raster, tin::Triangulation tin, const FitOptions& options) {
  return fit(raster, std::move(tin), {}, options);
}

}  // namespace scarp::fit
