// Triangles for simulation: Delaunay refinement on the lattice between samples, together with the error bound.
//
// A triangle with too small an angle is given a vertex near the centre of its circle: the off-centre (A. Üngör, 2004),
// which makes the angle over its shortest edge just what was asked, else the centre. Where that lies beyond an outline
// or a line, or in the circle over one of its edges, the edge is halved instead (J. Ruppert, "A Delaunay refinement
// algorithm for quality 2-dimensional mesh generation", 1995), at corners of less than 45 degrees at powers of two from
// the corner (J. R. Shewchuk, "Delaunay refinement algorithms for triangular mesh generation", 2002), so that both
// sides get edges of the same lengths. A triangle that is too large gets the centre of its circle, or else its longest
// edge is halved.
//
// Differences: edges with vertices in their circle are split only if a bad triangle requires it. Every vertex has a
// lattice point of its own, on samples where that is fine enough. Between any two steps samples that break the bound
// are inserted, worst first, as always. Refinement ends for any goal: vertices added for angles stay 1/32 of a sample
// from all others, edges are split for size only while they are longer than allowed, and samples are finite.
//
// If the samples are streamed, the mesh is in memory, and bands of rows are processed from the top down. Bad triangles
// of a band are treated while its samples and some around are held. Triangles changed further up or down are refined to
// the bound at once; their shapes are treated in their own bands, if necessary in the next sweep. So there are no
// borders between bands, and the goals hold as they do in memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "fit/rules.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "metric/source_bounds.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

struct ShapeTask {
  ShapeGoals goals;
  std::array<double, 6> affine;        ///< affine map of the frame
  double threshold = 0;                ///< threshold of errors
  std::span<const float> bounds = {};  ///< bounds of samples, as LatticeMetric has them
  bool all_may_go = false;             ///< who comes next may remove, or move, vertices that are no samples
  /// Receives the share of the bands that have been gone through once, all if there are none, the number of vertices
  /// and the worst error; a failure ends the run.
  std::function<Result<void>(double share, std::uint64_t vertices, double error)> progress = {};
  /// Receives once, before all, the least number of triangles; a failure ends the run.
  std::function<Result<void>(double triangles)> foresee = {};
  /// For a raster without samples: the field whose source has them, alive, and how many rows are held at a time, at
  /// least 4. Then bounds of samples come from windows, too; null: the threshold holds for all.
  const HeightField* field = nullptr;
  const SourceBounds* source_bounds = nullptr;
  std::int32_t rows_at_once = 0;
};

struct ShapeWork {
  std::uint64_t samples_scanned = 0, triangles_scanned = 0, insertions = 0;
};

/// Makes `tin` Delaunay in the frame, but for constrained edges, and adds vertices until every sample keeps its bound
/// and the goals hold as described at ShapeGoals. `lattice`: of the vertices; afterwards in kLatticeSteps, those fixed
/// that were, or that are no samples unless vertices are free. Fails with kInput for too many triangles, and as
/// progress and foresee do; throws SourceFailure. REQUIRES: goals that were checked; sides of at most kMaxCoordinate /
/// kLatticeSteps samples; an outline that is exact. Cost: expected O(log n) an insertion, but for scanning.
Result<ShapeWork> refine_shapes(const Raster& raster, Triangulation& tin, VertexLattice& lattice,
                                const ShapeTask& task);

/// Most bytes a vertex that this uses, the mesh included.
inline constexpr std::uint64_t kShapeBytesPerVertex = 240;

/// The rule that keeps angles and lengths of edges, as refine_shapes() has made them, while vertices are removed and
/// moved. Nothing where only insertion can: with a grade, and where rows and columns of the frame are not at right
/// angles.
std::optional<ShapeRule> shape_rule(const ShapeGoals& goals, const Frame& frame);

/// The effect of lines and outline on the other goals.
struct ShapeLosses {
  std::uint64_t forced = 0;        ///< triangles with small angles in corners between lines or outline
  std::uint64_t beside_lines = 0;  ///< other such triangles with a corner on lines or outline
  std::uint64_t short_edges = 0;   ///< with an end on lines or outline
};
/// `steps`: of the lattice of `tin`, from a sample to the next.
ShapeLosses count_losses(const Triangulation& tin, std::int32_t steps, const Frame& frame, const ShapeGoals& goals);

/// Shapes of a finished mesh. `losses`: of the triangulation that it was made of.
ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, const ShapeLosses& losses);

}  // namespace scarp
