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

namespace scarp {

/// Heights of samples, in memory or in a source. Throws SourceFailure if a source fails.
class SampleHeights {
 public:
  explicit SampleHeights(const Raster& raster) : raster_(raster) {}
  /// Heights for a field with a source, which stays alive. `known`: heights of the first vertices, so that they need
  /// not be read.
  SampleHeights(const HeightField& field, std::span<const float> known)
      : raster_{nullptr, field.cols, field.rows}, source_(field.source), known_(known) {}

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  bool are_in_memory() const { return source_ == nullptr; }
  float at(Point p) const;  ///< NaN is nodata
  float at_vertex(Vertex v, Point p) const { return v < known_.size() ? known_[v] : at(p); }

 private:
  Raster raster_;
  const SampleSource* source_ = nullptr;
  std::span<const float> known_;
};

/// How vertices become positions in the frame: offsets from frame_origin(), or from that of a frame in space, rounded
/// to float32 if asked; heights as they are, but in space. Its references outlive it.
struct VertexPositions {
  const SampleHeights& heights;
  const VertexLattice& lattice;  ///< lattice of the vertices; their heights come before those of samples
  const Frame& frame;
  bool round_to_float32 = false;
};

/// The triangles that are not outside, with the vertices they use. Counter-clockwise from above whatever way the frame
/// turns. Ids follow the order of insertion. The mesh does not depend on threads.
Mesh freeze(const Triangulation& tin, const VertexPositions& positions, int threads = 1);

/// Those of freeze()'s vertices, in its order.
LatticePoints frozen_points(const Triangulation& tin, const VertexLattice& lattice);

/// The mesh of freeze(), or that mesh in the order of optimize_order(), from a triangulation that gives its memory back
/// step by step: in affine frames at most 64 bytes a vertex are in use at a time, else 88. Used once, from top to
/// bottom.
class MeltDown {
 public:
  MeltDown(Triangulation tin, const VertexPositions& positions, int threads);

  std::size_t vertex_count() const { return numbers_ ? numbers_->count : tin_.vertex_count(); }
  std::size_t triangle_count() const { return (ordered_.empty() ? corners_.size() : ordered_.size()) / 3; }

  void order();
  Mesh finish();
  /// Positions of the finished mesh's vertices.
  LatticePoints points() const;

 private:
  bool is_used(Vertex v) const { return !numbers_ || numbers_->ids[v] != VertexNumbers::kUnused; }
  std::uint32_t number(Vertex v) const { return numbers_ ? numbers_->ids[v] : v; }
  void find_places(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places) const;

  Triangulation tin_;
  VertexPositions way_;
  int threads_;
  Array<Vertex> corners_;                 // until the triangles are ordered
  std::optional<VertexNumbers> numbers_;  // nothing: all vertices are used, as they are
  std::vector<double> positions_;         // by vertex; empty in affine frames, where they are quickly made again
  std::vector<std::uint32_t> ordered_;    // corners; empty before
};

/// To multiples of a power of two.
void round_heights(Mesh& mesh, double step);

}  // namespace scarp
