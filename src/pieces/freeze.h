// From the triangulation to the final mesh.
#pragma once

#include <span>
#include <vector>

#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "scarp/frame.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "tin/triangulation.h"

namespace scarp {

/// Heights of samples, in memory or in a source. Throws SourceFailure if a source fails.
class SampleHeights {
 public:
  explicit SampleHeights(const Raster& raster) : raster_(raster) {}
  /// Of a field with a source, which stays alive. `known`: heights of the first vertices, so that they need not be
  /// read.
  SampleHeights(const HeightField& field, std::span<const float> known)
      : raster_{nullptr, field.cols, field.rows}, source_(field.source), known_(known) {}

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  float at(Point p) const;  ///< NaN is nodata
  float at_vertex(Vertex v, Point p) const { return v < known_.size() ? known_[v] : at(p); }

 private:
  Raster raster_;
  const SampleSource* source_ = nullptr;
  std::span<const float> known_;
};

/// The triangles that are not outside, with the vertices they use, in the frame: offsets from frame_origin(), or from
/// that of a frame in space, rounded to float32 if asked; heights as they are, but in space. Counter-clockwise from
/// above whatever way the frame turns. Ids follow the order of insertion. `lattice`: of the vertices; their heights
/// come before those of samples.
Mesh freeze(const SampleHeights& heights, const Triangulation& tin, const VertexLattice& lattice, const Frame& frame,
            bool round_to_float32);

/// The same, but frees the triangulation step by step: at most 72 bytes a vertex are in use at a time.
Mesh melt_down(const SampleHeights& heights, Triangulation tin, const VertexLattice& lattice, const Frame& frame,
               bool round_to_float32);

/// To multiples of a power of two.
void round_heights(Mesh& mesh, double step);

/// Lattice points, with `steps` steps from one sample to the next.
struct LatticePoints {
  std::int32_t steps = 1;
  std::vector<Point> points;
};

/// Those of freeze()'s vertices, in its order.
LatticePoints frozen_points(const Triangulation& tin, const VertexLattice& lattice);

/// Positions in the raster's image: pixel centres, (0, 0) the image's top left corner and (1, 1) its bottom right; 2
/// values a point.
std::vector<float> sample_uvs(std::int32_t cols, std::int32_t rows, const LatticePoints& at);

}  // namespace scarp
