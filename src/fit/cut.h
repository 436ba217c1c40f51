// Cuts a triangulation into patches, and joins them again.
//
// A triangle belongs to the square of samples that contains its centre. This rule uses only geometry, so patches are
// the same on any number of threads. Vertices on borders between patches are locked; squares shifted by half a side
// free these vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/patch.h"
#include "fit/scattered_samples.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "tin/triangulation.h"

namespace scarp::fit {

/// Squares of `side` samples, the first of which begins `shift` samples before the raster in both directions.
struct PatchGrid {
  std::int32_t side = 0, shift = 0;
};

/// The sides of the rectangle whose vertices may be removed.
struct FreeSides {
  bool left = true, top = true, right = true, bottom = true;
};

class PatchCutter {
 public:
  /// Raster, triangulation and lattice must outlive this object. `points`: as in FitOptions.
  PatchCutter(const grid::Raster& raster, const tin::Triangulation& tin, const grid::VertexLattice& lattice,
              const PatchGrid& grid, const FreeSides& free_sides, int threads,
              const ScatteredSamples* points = nullptr);

  std::size_t count() const { return begins_.size() - 1; }

  /// Memory of one thread, reused between calls: a number for each vertex of the triangulation.
  struct Scratch {
    std::vector<std::uint32_t> ids;
  };
  /// Returns the patch; stores the vertex of each node in `vertices`. All nodes are locked if the patch exceeds the
  /// range of the arithmetic: longer than kMaxFitSteps, or heights beyond kMaxScanHeight.
  Patch cut(std::size_t i, Scratch& scratch, std::vector<tin::Vertex>& vertices) const;

  /// The joined triangulation: the triangles of the changed patches, patch by patch, then the triangles outside.
  /// Removed vertices are omitted; moved ones have their new places. `numbers`: the new number of each old vertex, or
  /// kNone. `joined`: the lattice of the new vertices; its steps are an input. Fixed vertices stay fixed. Nodes that
  /// were added to a patch become new vertices with the last numbers. REQUIRES: patches are packed; joined.steps equals
  /// the cutter's, or is kLatticeSteps where the cutter's is 1.
  tin::Triangulation join(std::vector<Patch> patches, std::vector<std::vector<tin::Vertex>> vertices,
                          std::vector<tin::Vertex>& numbers, grid::VertexLattice& joined) const;

 private:
  struct LatticePoint {
    std::int64_t x, y;  ///< in kLatticeSteps from the raster's first sample
  };
  struct Borders;
  struct Parts;

  std::vector<std::uint32_t> assign_squares(std::size_t outside);
  void sort_by(const std::vector<std::uint32_t>& blocks, std::size_t count);
  bool is_inner(tin::HalfEdge h, std::size_t i) const;
  bool add_nodes(std::size_t i, Scratch& scratch, Patch& patch, std::vector<tin::Vertex>& vertices) const;
  void add_faces(std::size_t i, const Scratch& scratch, Patch& patch) const;
  void lock(Patch& patch) const;
  bool is_on_free_side(const LatticePoint& p, const LatticePoint& q) const;
  float height_of(tin::Vertex v) const;
  void number_vertices(const std::vector<Patch>& patches, const std::vector<std::vector<tin::Vertex>>& vertices,
                       Parts& parts) const;
  void place_vertices(const std::vector<Patch>& patches, const std::vector<std::vector<tin::Vertex>>& vertices,
                      Parts& parts, grid::VertexLattice& joined) const;
  void add_patch(const Patch& patch, const std::vector<tin::Vertex>& names, std::size_t i, Parts& parts) const;
  void add_outside(Parts& parts) const;
  tin::HalfEdge name_now(tin::HalfEdge before, const Parts& parts) const;

  const grid::Raster& raster_;
  LatticePoint last_;  // last column and row
  const tin::Triangulation& tin_;
  const grid::VertexLattice& lattice_;
  PatchGrid grid_;
  FreeSides free_sides_;
  int threads_;
  std::size_t squares_per_row_;
  std::vector<std::size_t> begins_;  // by patch, its first triangle in order_; the last patch: outside
  std::vector<tin::Triangle> order_;
  std::vector<std::uint32_t> index_in_patch_;  // by triangle, its index among those of its patch
  std::vector<std::uint32_t> square_;          // by triangle
};

}  // namespace scarp::fit
