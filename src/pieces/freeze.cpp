#include "pieces/freeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "grid/source_failure.h"
#include "pieces/offset_map.h"

namespace scarp {

namespace {

/// Ids of the vertices in the mesh.
class VertexNumbers {
 public:
  explicit VertexNumbers(const Triangulation& tin) : count_(static_cast<std::uint32_t>(tin.vertex_count())) {
    bool is_whole = true;
    for (Triangle t = 0; t < tin.triangle_count() && is_whole; ++t) is_whole = !tin.is_outside(t);
    if (is_whole) return;
    ids_.assign(count_, kNone);
    for (HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
      if (!tin.is_outside(h / 3)) ids_[tin.origin(h)] = 0;
    }
    count_ = 0;
    for (auto& id : ids_) {
      if (id != kNone) id = count_++;
    }
  }
  std::uint32_t count() const { return count_; }
  /// kNone where no triangle of the domain uses the vertex.
  std::uint32_t of(Vertex v) const { return ids_.empty() ? v : ids_[v]; }

 private:
  std::uint32_t count_;
  std::vector<std::uint32_t> ids_;  // empty: every vertex is used
};

/// Seen along `up`.
double twice_area(const Mesh& mesh, const std::array<double, 3>& up) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double* a = &mesh.positions[3 * mesh.triangles[3 * t]];
    const double* b = &mesh.positions[3 * mesh.triangles[3 * t + 1]];
    const double* c = &mesh.positions[3 * mesh.triangles[3 * t + 2]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (up[k] != 0) sum += up[k] * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
    }
  }
  return sum;
}

void add_triangles(const Triangulation& tin, const VertexNumbers& numbers, Mesh& mesh) {
  std::size_t count = 0;
  for (Triangle t = 0; t < tin.triangle_count(); ++t) count += !tin.is_outside(t);
  mesh.triangles.reserve(3 * count);
  for (Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) mesh.triangles.push_back(numbers.of(tin.origin(h)));
  }
}

void add_positions(const SampleHeights& heights, const Triangulation& tin, const VertexNumbers& numbers,
                   const VertexLattice& lattice, const Frame& frame, bool round_to_float32, Mesh& mesh) {
  mesh.positions.reserve(3 * std::size_t{numbers.count()});
  const OffsetMap offsets(heights.cols(), heights.rows(), frame, lattice.steps);
  std::vector<Vertex> vertices;
  std::vector<Point> chunk;
  std::vector<double> x, y, z;
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (numbers.of(v) != kNone) {
      vertices.push_back(v);
      chunk.push_back(tin.point(v));
    }
    if (chunk.size() < kChunkVertices && v + 1 < tin.vertex_count()) continue;
    z.clear();
    for (std::size_t k = 0; k < chunk.size(); ++k)
      z.push_back(lattice.are_samples() ? heights.at_vertex(vertices[k], chunk[k]) : lattice.heights[vertices[k]]);
    offsets.map(chunk, x, y, z);
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      for (double offset : {x[k], y[k], z[k]})
        mesh.positions.push_back(round_to_float32 ? static_cast<float>(offset) : offset);
    }
    vertices.clear();
    chunk.clear();
  }
  mesh.origin = offsets.origin();
}

/// Triangles are positive on the lattice; where the frame turns them over they are turned back.
void face_up(const Frame& frame, Mesh& mesh) {
  const std::array<double, 3> up = frame.space ? frame.space->up() : std::array<double, 3>{0, 0, 1};
  if (frame.is_affine() ? frame.determinant() > 0 : twice_area(mesh, up) >= 0) return;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
}

}  // namespace

float SampleHeights::at(Point p) const {
  if (source_ == nullptr) return raster_.at(p);
  float height = 0;
  if (auto read = source_->read(p.x, p.y, 1, 1, &height, 1); !read) throw SourceFailure{read.error()};
  return height;
}

LatticePoints frozen_points(const Triangulation& tin, const VertexLattice& lattice) {
  const VertexNumbers numbers(tin);
  LatticePoints at{lattice.steps, {}};
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (numbers.of(v) != kNone) at.points.push_back(tin.point(v));
  }
  return at;
}

std::vector<float> sample_uvs(std::int32_t cols, std::int32_t rows, const LatticePoints& at) {
  std::vector<float> uvs;
  uvs.reserve(2 * at.points.size());
  const double steps = at.steps;
  for (Point p : at.points) {
    uvs.push_back(static_cast<float>((p.x / steps + 0.5) / cols));
    uvs.push_back(static_cast<float>((p.y / steps + 0.5) / rows));
  }
  return uvs;
}

Mesh freeze(const SampleHeights& heights, const Triangulation& tin, const VertexLattice& lattice, const Frame& frame,
            bool round_to_float32) {
  Mesh mesh;
  const VertexNumbers numbers(tin);
  add_triangles(tin, numbers, mesh);
  add_positions(heights, tin, numbers, lattice, frame, round_to_float32, mesh);
  face_up(frame, mesh);
  return mesh;
}

Mesh melt_down(const SampleHeights& heights, Triangulation tin, const VertexLattice& lattice, const Frame& frame,
               bool round_to_float32) {
  Mesh mesh;
  tin.drop_links();
  const VertexNumbers numbers(tin);
  add_triangles(tin, numbers, mesh);
  tin.drop_triangles();
  add_positions(heights, tin, numbers, lattice, frame, round_to_float32, mesh);
  face_up(frame, mesh);
  return mesh;
}

void round_heights(Mesh& mesh, double step) {
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3)
    mesh.positions[i] = std::nearbyint(mesh.positions[i] / step) * step;
}

}  // namespace scarp
