// Triangles for simulation: Delaunay refinement on the lattice between samples, together with the error bound.
//
// In a triangle with too small an angle, a vertex is inserted near the circumcentre: first at the off-centre (A. Üngör,
// 2004), which makes the angle over the shortest edge just as requested, else at the circumcentre. If the point is
// beyond an outline or a line, or in the diametral circle of one of their edges, this edge is halved instead (J.
// Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh generation", 1995). At a corner of less than
// 45 degrees, the edge is split at a power of two from the corner (J. R. Shewchuk, "Delaunay refinement algorithms for
// triangular mesh generation", 2002), so that both sides have edges of the same lengths. In a triangle that is too
// large, the circumcentre is inserted, or else the longest edge is halved.
//
// Differences: edges with vertices in their circle are split only if a bad triangle requires it. Every vertex is a
// lattice point, on a sample if samples are fine enough. After each step, samples that break the bound are inserted,
// worst first. Refinement terminates for any goal: vertices added for angles stay 1/32 of a sample from all others,
// edges are split for size only while they are longer than allowed, and the number of samples is finite.
//
// If samples are streamed, the mesh is in memory, and bands of rows are processed from the top down. Bad triangles of a
// band are treated while its samples, and some around it, are held. Changed triangles elsewhere are refined to the
// bound at once, but their shapes are treated in their own bands, if necessary in the next sweep. So bands have no
// borders, and the goals hold as for samples in memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "base/reporter.h"
#include "fit/rules.h"
#include "grid/raster.h"
#include "grid/snapped_points.h"
#include "grid/vertex_lattice.h"
#include "metric/source_bounds.h"
#include "refine/scattered.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp::shape {

struct ShapeTask {
  ShapeGoals goals;
  std::array<double, 6> affine;
  double threshold = 0;
  std::span<const float> bounds = {};  ///< bounds of samples, like those of LatticeMetric
  bool all_may_go = false;             ///< later passes may remove or move vertices that are not samples
  /// Receives the fraction of bands that were processed at least once (1 without bands), the number of vertices and the
  /// worst error; a failure ends the run.
  std::function<Result<void>(double share, std::uint64_t vertices, double error)> progress = {};
  /// Receives the least number of triangles once, at the start; a failure ends the run.
  std::function<Result<void>(double triangles)> foresee = {};
  /// For a raster without samples: the borrowed field whose source has them, and the number of rows held at a time, at
  /// least 4. Bounds of samples then also come from windows; null: the threshold applies to all.
  const HeightField* field = nullptr;
  const metric::SourceBounds* source_bounds = nullptr;
  std::int32_t rows_at_once = 0;
};

struct ShapeWork {
  std::uint64_t samples_scanned = 0, triangles_scanned = 0, insertions = 0;
};

/// Makes `tin` Delaunay in the frame, except constrained edges. Adds vertices until every sample satisfies its bound
/// and the goals hold as ShapeGoals describes. `lattice`: that of the vertices; afterwards its steps are kLatticeSteps.
/// Fixed vertices remain fixed; vertices between samples become fixed unless vertices are free. Fails with kInput for
/// too many triangles, and like progress and foresee; throws SourceFailure. REQUIRES: checked goals; sides of at most
/// kMaxCoordinate / kLatticeSteps samples; an exact outline. Cost: expected O(log n) per insertion, without scanning.
Result<ShapeWork> refine_shapes(const grid::Raster& raster, tin::Triangulation& tin, grid::VertexLattice& lattice,
                                const ShapeTask& task);

/// The same on scattered points. `domain` keeps its outline; vertices between points are free. `bounds`: as for
/// ScatteredRefinement. Fails with kInput for too many triangles, and with kCancelled. REQUIRES: points with
/// PointSteps::kFloat32 or kFit.
Result<ShapeWork> refine_shapes(const grid::SnappedPoints& points, std::span<const double> heights,
                                refine::ScatteredDomain& domain, const ShapeGoals& goals, double threshold,
                                std::span<const double> bounds, Reporter& reporter);

/// Most bytes that refine_shapes() uses per vertex, including the mesh.
inline constexpr std::uint64_t kShapeBytesPerVertex = 240;

/// The rule that preserves the angles and edge lengths of refine_shapes() while vertices are removed and moved. Nothing
/// if only insertion can preserve them: with a grade, or if rows and columns of the frame are not perpendicular.
std::optional<fit::ShapeRule> shape_rule(const ShapeGoals& goals, const Frame& frame);
std::optional<fit::ShapeRule> shape_rule(const ShapeGoals& goals, const grid::PointLattice& lattice);

/// The effect of lines and outline on the other goals.
struct ShapeLosses {
  std::uint64_t forced = 0;        ///< triangles with a small angle in a corner between lines or outline
  std::uint64_t beside_lines = 0;  ///< other such triangles with a corner on lines or outline
  std::uint64_t short_edges = 0;   ///< edges with an end on lines or outline
};
/// `steps`: lattice steps per sample.
ShapeLosses count_losses(const tin::Triangulation& tin, std::int32_t steps, const Frame& frame,
                         const ShapeGoals& goals);

/// Shapes of a finished mesh. `losses`: those of its triangulation.
ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, const ShapeLosses& losses);
/// The same for points, on the lattice of `tin`.
ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, const tin::Triangulation& tin,
                          const grid::PointLattice& lattice);

}  // namespace scarp::shape
