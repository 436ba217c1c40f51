// Lines inserted into the triangulation after refinement, which then continues around them.
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

namespace scarp::lines {

/// Vertices, and edges between them. Edges share only end points, and contain no vertex in their interior.
struct ConstraintGraph {
  std::vector<Point> points;                        ///< in kLatticeSteps, in the raster, each once
  std::vector<float> heights;                       ///< heights of the points; the height of a sample has precedence
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< indices of points
  std::vector<std::uint8_t> is_shared;  ///< by point: 1 if it is also inserted outside the domain; EMPTY: none is
  std::vector<std::uint8_t> is_start;   ///< by edge: 1 if the final mesh need not contain it; EMPTY: all are permanent
  bool is_inserted_first = false;       ///< edges are inserted before the surface is refined
  std::optional<SurfaceCut> cut;        ///< none: no cut
};

/// A triangulation with constraints.
class ConstrainedMesh {
 public:
  /// Converts the points of `tin` from samples to kLatticeSteps and inserts the graph's edges as chains of constrained
  /// edges. Then marks the removed part as outside. Points outside the domain, except shared ones, are omitted with
  /// their edges. `tin` and the raster must outlive the result; no other code may change them. Fails with kInternal
  /// where an edge crosses a constrained one. REQUIRES: sides of at most kMaxCoordinate / kLatticeSteps samples; edges
  /// cross constrained edges of `tin` only in points of the graph.
  static Result<ConstrainedMesh> insert(const grid::Raster& raster, tin::Triangulation& tin,
                                        const ConstraintGraph& graph);

  /// False if a cut removes all surface.
  bool has_surface() const { return has_surface_; }
  /// Changed triangles, ascending.
  const std::vector<tin::Triangle>& changed() const { return changed_; }
  /// Releases the edges that are only starts, and the vertices that belong to no other edge of the graph.
  void release_starts(tin::Triangulation& tin);

  const metric::LatticeHeights& heights() const { return heights_; }
  /// The lattice of all current vertices of `tin`: their heights, and the vertices that the graph still fixes.
  /// REQUIRES: on several threads, the samples are a raster, not rows.
  grid::VertexLattice lattice(int threads = 1) const;

 private:
  ConstrainedMesh(const grid::Raster& raster, const tin::Triangulation& tin) : tin_(&tin), heights_(raster) {}

  const tin::Triangulation* tin_;
  metric::LatticeHeights heights_;
  std::vector<tin::Vertex> fixed_, starts_;  // starts_: vertices that belong only to starts
  std::vector<std::array<tin::Vertex, 2>> start_edges_;
  std::vector<tin::Triangle> changed_;
  bool has_surface_ = true;
};

}  // namespace scarp::lines
