// The interface of fitting, which makes a mesh smaller while it satisfies the same bound.
//
// The mesh is cut into patches (cut.h), and each patch is reduced alone (removal.h). Squares shifted by half then
// remove the vertices along the first borders. Rounds of removal with repair (schedule.h) follow if wanted, on squares
// that grow as triangles become fewer, shifted in turn. A last round treats vertices near the borders of the others,
// and polishes heights. Patches depend on the mesh only, so the result is the same on any number of threads.
//
// Against one patch for all, over 32 cases of eight rasters from 2 to 0.2 % of the relief, kHighDepth in patches keeps
// 98.9 to 100.6 % of the triangles. With squares that stay, and without the last round, it was 101.1 to 101.3 % on one
// of 1197 x 643 samples; that round needs some 3 % of the time.
//
// If there is time left, rounds continue. Repair alone soon finds nothing more; but it does after all vertices have
// been moved a little, within the bound. Max at 1 % of the relief, with shapes of at least a tenth, keeps 0.237 of
// greedy's triangles on Fuji, 0.263 on Crater Lake; after five to six times its time 0.230, 0.254.
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

namespace scarp {

/// How far fitting goes beyond removal.
struct FitDepth {
  /// After the first removal each vertex moves to a better sample, and removal continues (relocation.h).
  bool relocates = false;
  int rounds = 0;  ///< over all vertices, of removal with repair (schedule.h)
  RepairDepth repair = {};
  int polishes = 0;  ///< sweeps in the end that lower the squared error
};

inline constexpr FitDepth kNormalDepth{true};
/// bench/quality/efforts.csv lists the share of greedy's triangles for each of these, and its time.
inline constexpr FitDepth kHighDepth{true, 2, {6, 3, false, true}, 9};
inline constexpr FitDepth kMaxDepth{true, 3, {6, 3, true, true, true, 4}, 9};

inline constexpr std::uint64_t kNoBudget = std::numeric_limits<std::uint64_t>::max();

/// A budget, within which the squared error is to become small (square_rounds.h).
struct SquareGoal {
  std::uint64_t most_triangles = kNoBudget, most_vertices = kNoBudget;
  int exchanges = 6;
};

struct FitOptions {
  double threshold = 0;
  /// Bounds of samples with bounds of their own, row-major like the raster: at least 0, +infinity for none, no NaN.
  /// They stand in for the threshold; energies count errors in them. EMPTY: the threshold holds for all.
  std::span<const float> bounds = {};
  /// Scattered samples in place of the raster's, which then has none: a sample of its is a cell of kLatticeSteps. Then
  /// vertices have heights of their own, and lie on the lattice. They stay alive. DEFAULT: null, the raster's.
  const ScatteredSamples* points = nullptr;
  /// Errors are norms over several fields. Then vertices stay on samples, and heights alone are not bounded. Stays
  /// alive. DEFAULT: null, of heights alone.
  const FitNorm* norm = nullptr;
  int threads = 0;
  /// Vertices must stay on sides that are no straight lines in the mesh's frame, or that are shared with others.
  FreeSides free_sides = {};
  /// If it relocates or has rounds, vertices become other samples.
  FitDepth depth = {};
  /// Floor of the shapes of triangles, 2·area over the longest edge squared (rules.h); 0: none. A tenth costs 2 to 6 %
  /// of the triangles and saves time. Triangles of the mesh that is given may lie below; no move makes the worst worse.
  double min_shape = 0;
  /// The floor does not bind removal, which comes first, nor repair of patches where more than kThinShare of the
  /// triangles after removal lie below it: there long thin triangles suit the heights.
  bool floor_yields = false;
  double aspect = 1;  ///< aspect of a sample: its height over its width, with which shapes are computed
  /// Replaces these two: angles, lengths of edges. DEFAULT: none.
  std::optional<ShapeRule> shape = std::nullopt;
  /// Repair may put vertices between samples, on the lattice of fitting, and at heights of their own.
  bool vertices_are_free = false;
  std::int32_t patch_side = 0;  ///< in samples; 0: squares of kPatchTriangles, one for small meshes
  std::int32_t most_side = 0;   ///< largest side of squares, in samples, whatever they hold; 0: any
  /// Copies the samples of a window to `to`, nodata as NaN, and may throw; asked on any thread. DEFAULT: none, the
  /// raster has them.
  ReadWindow read = {};
  /// The same of their bounds, in place of `bounds`. DEFAULT: none, the threshold or `bounds` hold.
  ReadWindow read_bounds = {};
  std::int64_t most_window = 0;  ///< samples; patches that would have more read stay as they are; 0: any
  /// Receives the share that is done and the number of vertices, on the calling thread; false stops with kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
  /// Asked often, on any thread; once true, true for good. Then the rounds end, and what stands is the result.
  std::function<bool()> is_time_up = {};
  /// Rounds continue until the time is up beyond those of the depth, if that has any, each after all vertices have been
  /// shaken, until two in a row gain less than a thousandth.
  bool goes_on = false;
  /// In place of removal and rounds. DEFAULT: none.
  std::optional<SquareGoal> squares = std::nullopt;
};

/// Share of the triangles of a patch. After removal 0.03 to 0.11 of them lie below a floor of a tenth on natural land,
/// 0.04 to 0.15 on trees, 0.27 to 0.51 on buildings.
inline constexpr double kThinShare = 0.15;

/// A patch of so many triangles and what belongs to it fits the caches of one core.
inline constexpr std::int64_t kPatchTriangles = 8192;

/// The most memory for a vertex of the mesh that is given, that mesh included: with one thread these two, with each
/// more the second.
inline constexpr std::uint64_t kFitBytesPerVertex = 200;
inline constexpr std::uint64_t kFitBytesPerVertexAndThread = 6;

struct FitCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< number of rings examined
  std::uint64_t repaired = 0;  ///< number of the removed vertices that went with repair
  std::uint64_t tried = 0;     ///< removals with repair that were begun
};

struct Fitted {
  Triangulation tin;  ///< its points in lattice.steps
  FitCounts counts;
  /// Steps of kLatticeSteps, and heights, if vertices were free; else they are samples. Heights lie between
  /// the lowest and the highest valid sample of the raster, so that nothing is deeper than a sea of height 0.
  VertexLattice lattice;
  bool is_cut_short = false;  ///< by the time
};

/// `lattice`: of the vertices of `tin`.
///
/// A triangulation of some of the vertices with the same domain and constraints, whose triangles keep the threshold at
/// every sample of the domain, or its bound, in exact arithmetic. Vertices of the outline stay, but for those on the
/// sides of the rectangle; repair may move the others, on a side along it. Where heights or extents are beyond
/// kMaxScanHeight, kMaxFitSteps, triangles stay as they are. Thresholds beyond 2⁻⁶⁰ … 2⁶⁰ are not repaired, sides
/// beyond kMaxCoordinate / kLatticeSteps samples on samples only. Fails with kCancelled only. REQUIRES: the triangles
/// inside keep the threshold, in the eyes of the norm's find_breach if there is one, and hold valid corners; threshold
/// >= 0 and finite; a vertex that is not fixed, and no end of a constrained edge within the rectangle, is a sample, or
/// vertices are free, or the depth has no rounds.
Result<Fitted> fit(const Raster& raster, Triangulation tin, VertexLattice lattice, const FitOptions& options);
inline Result<Fitted> fit(const Raster& raster, Triangulation tin, const FitOptions& options) {
  return fit(raster, std::move(tin), {}, options);
}

}  // namespace scarp
