// Constraints: lines inserted into the triangulation after refinement, which then continues around them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "lines/cut_away.h"
#include "metric/lattice_metric.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

/// Vertices, and edges between them. Edges share end points only, and contain no vertex in their interior.
struct ConstraintGraph {
  std::vector<Point> points;                        ///< in kLatticeSteps, in the raster, each once
  std::vector<float> heights;                       ///< heights of the points; the height of a sample has precedence
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< indices of points
  std::vector<std::uint8_t> is_shared;  ///< by point: 1 where it is inserted outside the domain, too; EMPTY: none is
  std::vector<std::uint8_t> is_start;   ///< by edge: 1 where the mesh need not hold it in the end; EMPTY: all stay
  bool is_inserted_first = false;       ///< before the surface is refined
  std::optional<SurfaceCut> cut;        ///< nothing: all of the surface stays
};

/// A triangulation with constraints.
class ConstrainedMesh {
 public:
  /// Turns the points of `tin` from samples into kLatticeSteps, and makes the graph's edges chains of its edges,
  /// constrained; then what is cut away is marked outside. Points outside the domain, but for shared ones, are omitted
  /// with their edges. `tin` and the raster stay alive; no other code changes them. Fails with kInternal where an edge
  /// crosses one that is constrained. REQUIRES: sides of at most kMaxCoordinate / kLatticeSteps samples; edges cross no
  /// constrained edge of `tin` but in points of the graph.
  static Result<ConstrainedMesh> insert(const Raster& raster, Triangulation& tin, const ConstraintGraph& graph);

  /// True if some surface remains after a cut, if there is one.
  bool has_surface() const { return has_surface_; }
  /// Changed triangles, ascending.
  const std::vector<Triangle>& changed() const { return changed_; }
  /// Frees the edges that are only a start, and the vertices that belong to no other edge of the graph.
  void release_starts(Triangulation& tin);

  const LatticeHeights& heights() const { return heights_; }
  /// The lattice of all vertices that `tin` has by now: heights, and which of them belong to the graph and are not
  /// released. With several threads the samples are those of a raster, not of rows.
  VertexLattice lattice(int threads = 1) const;

 private:
  ConstrainedMesh(const Raster& raster, const Triangulation& tin) : tin_(&tin), heights_(raster) {}

  const Triangulation* tin_;
  LatticeHeights heights_;
  std::vector<Vertex> fixed_, starts_;  // the latter: vertices of starts only
  std::vector<std::array<Vertex, 2>> start_edges_;
  std::vector<Triangle> changed_;
  bool has_surface_ = true;
};

}  // namespace scarp
