// From the triangulation to the final mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/array.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "mesh/order.h"
#include "pieces/vertex_attributes.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "tin/triangulation.h"

namespace scarp::pieces {

/// Heights of samples, in memory or in a source. Throws SourceFailure if a source fails.
class SampleHeights {
 public:
  explicit SampleHeights(const grid::Raster& raster) : raster_(raster) {}
  /// Heights of a field with a source, which must outlive this. `known`: heights of the first vertices, which need not
  /// be read.
  SampleHeights(const HeightField& field, std::span<const float> known)
      : raster_{nullptr, field.cols, field.rows}, source_(field.source), known_(known) {}

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  bool are_in_memory() const { return source_ == nullptr; }
  float at(Point p) const;  ///< NaN is nodata
  float at_vertex(tin::Vertex v, Point p) const { return v < known_.size() ? known_[v] : at(p); }

 private:
  grid::Raster raster_;
  const SampleSource* source_ = nullptr;
  std::span<const float> known_;
};

/// Maps vertices to positions in the frame: offsets from frame_origin(), or from the origin of a frame in space,
/// rounded to float32 on request. Heights do not change, except in space. The references must outlive this.
struct VertexPositions {
  const SampleHeights& heights;
  const grid::VertexLattice& lattice;  ///< lattice of the vertices; its heights override samples
  const Frame& frame;
  bool round_to_float32 = false;
};

/// The triangles inside the domain with their vertices, counter-clockwise from above even if the frame mirrors. Ids are
/// in order of insertion. The mesh does not depend on threads.
Mesh freeze(const tin::Triangulation& tin, const VertexPositions& positions, int threads = 1);

/// The lattice points of freeze()'s vertices, in its order.
LatticePoints frozen_points(const tin::Triangulation& tin, const grid::VertexLattice& lattice);

/// Makes the mesh of freeze(), optionally in the order of optimize_order(), and releases the triangulation's memory
/// step by step. At most 64 bytes a vertex are in use at a time in affine frames, else 88. Call each of its functions
/// once, in the order of their declaration.
class MeltDown {
 public:
  MeltDown(tin::Triangulation tin, const VertexPositions& positions, int threads);

  std::size_t vertex_count() const { return numbers_ ? numbers_->count : tin_.vertex_count(); }
  std::size_t triangle_count() const { return (ordered_.empty() ? corners_.size() : ordered_.size()) / 3; }

  void order();
  Mesh finish();
  /// Positions of the finished mesh's vertices.
  LatticePoints points() const;

 private:
  bool is_used(tin::Vertex v) const { return !numbers_ || numbers_->ids[v] != mesh::VertexNumbers::kUnused; }
  std::uint32_t number(tin::Vertex v) const { return numbers_ ? numbers_->ids[v] : v; }
  void find_places(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places) const;

  tin::Triangulation tin_;
  VertexPositions way_;
  int threads_;
  Array<tin::Vertex> corners_;                  // until the triangles are ordered
  std::optional<mesh::VertexNumbers> numbers_;  // none: all vertices are used and keep their numbers
  std::vector<double> positions_;               // by vertex; empty in affine frames, where they are cheap to recompute
  std::vector<std::uint32_t> ordered_;          // ordered corners; empty before ordering
};

/// Rounds heights to multiples of a power of two.
void round_heights(Mesh& mesh, double step);

}  // namespace scarp::pieces
