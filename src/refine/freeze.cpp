#include "refine/freeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace scarp {

namespace {

/// New id of each vertex that a triangle of the domain uses, kNone for the others.
std::vector<std::uint32_t> number_vertices(const Triangulation& tin) {
  std::vector<std::uint32_t> ids(tin.vertex_count(), kNone);
  for (HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) ids[tin.origin(h)] = 0;
  }
  std::uint32_t count = 0;
  for (auto& id : ids) {
    if (id != kNone) id = count++;
  }
  return ids;
}

/// Offsets of lattice points from the frame's origin, in double; a few thousand at a time, since double arrays of a
/// whole mesh would be the peak of memory.
class OffsetMap {
 public:
  OffsetMap(const Raster& raster, const Frame& frame)
      : frame_(frame),
        col0_(raster.cols / 2),
        row0_(raster.rows / 2),
        origin_(frame_origin(frame, raster.cols, raster.rows)) {}

  std::array<double, 2> origin() const { return origin_; }

  /// Fills x and y for a chunk of points.
  void map(std::span<const Point> points, std::vector<double>& x, std::vector<double>& y) const {
    x.clear();
    y.clear();
    for (Point p : points) {
      // In affine frames from differences of indices, so that offsets that are float32 by construction come out
      // exactly.
      const auto& a = frame_.affine;
      const double i = p.x - col0_, j = p.y - row0_;
      const std::array<double, 2> at =
          frame_.is_affine() ? std::array{a[1] * i + a[2] * j, a[4] * i + a[5] * j} : frame_.apply_affine(p.x, p.y);
      x.push_back(at[0]);
      y.push_back(at[1]);
    }
    if (frame_.is_affine()) return;
    frame_.transform->apply(x, y);
    for (std::size_t k = 0; k < points.size(); ++k) {
      x[k] -= origin_[0];
      y[k] -= origin_[1];
    }
  }

 private:
  const Frame& frame_;
  std::int32_t col0_, row0_;
  std::array<double, 2> origin_;
};

constexpr std::size_t kChunk = 4096;

double twice_area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double* a = &mesh.positions[3 * mesh.triangles[3 * t]];
    const double* b = &mesh.positions[3 * mesh.triangles[3 * t + 1]];
    const double* c = &mesh.positions[3 * mesh.triangles[3 * t + 2]];
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum;
}

}  // namespace

std::vector<Point> frozen_samples(const Triangulation& tin) {
  const auto ids = number_vertices(tin);
  std::vector<Point> points;
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (ids[v] != kNone) points.push_back(tin.point(v));
  }
  return points;
}

std::vector<float> sample_uvs(const Raster& raster, const std::vector<Point>& samples) {
  std::vector<float> uvs;
  uvs.reserve(2 * samples.size());
  for (Point p : samples) {
    uvs.push_back(static_cast<float>((p.x + 0.5) / raster.cols));
    uvs.push_back(static_cast<float>((p.y + 0.5) / raster.rows));
  }
  return uvs;
}

Mesh freeze(const Raster& raster, const Triangulation& tin, const Frame& frame, bool round_to_float32) {
  Mesh mesh;
  const auto ids = number_vertices(tin);
  std::size_t count = 0;
  for (Triangle t = 0; t < tin.triangle_count(); ++t) count += !tin.is_outside(t);
  mesh.triangles.reserve(3 * count);
  for (Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) mesh.triangles.push_back(ids[tin.origin(h)]);
  }
  const auto used =
      static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [](auto id) { return id != kNone; }));
  mesh.positions.reserve(3 * used);
  const OffsetMap offsets(raster, frame);
  std::vector<Point> chunk;
  std::vector<double> x, y;
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (ids[v] != kNone) chunk.push_back(tin.point(v));
    if (chunk.size() < kChunk && v + 1 < tin.vertex_count()) continue;
    offsets.map(chunk, x, y);
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      for (double offset : {x[k], y[k]})
        mesh.positions.push_back(round_to_float32 ? static_cast<float>(offset) : offset);
      mesh.positions.push_back(raster.at(chunk[k]));
    }
    chunk.clear();
  }
  mesh.origin = {offsets.origin()[0], offsets.origin()[1], 0};
  if (twice_area(mesh) < 0) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
  }
  return mesh;
}

std::vector<float> sample_normals(const Raster& raster, const Frame& frame, const std::vector<Point>& samples) {
  const OffsetMap offsets(raster, frame);
  const auto usable = [&](Point p) {
    return p.x >= 0 && p.y >= 0 && p.x < raster.cols && p.y < raster.rows && raster.is_valid(p);
  };
  std::vector<float> normals;
  normals.reserve(3 * samples.size());
  std::vector<Point> neighbours;  // west, east, north, south of each vertex; a missing one is the vertex itself
  std::vector<double> x, y;
  for (std::size_t begin = 0; begin < samples.size(); begin += kChunk) {
    neighbours.clear();
    for (Point p : std::span(samples).subspan(begin, std::min(kChunk, samples.size() - begin))) {
      for (Point q : {Point{p.x - 1, p.y}, Point{p.x + 1, p.y}, Point{p.x, p.y - 1}, Point{p.x, p.y + 1}})
        neighbours.push_back(usable(q) ? q : p);
    }
    offsets.map(neighbours, x, y);
    for (std::size_t k = 0; k < neighbours.size(); k += 4) {
      const auto difference = [&](std::size_t i, std::size_t j) {
        return std::array{x[j] - x[i], y[j] - y[i],
                          double{raster.at(neighbours[j])} - double{raster.at(neighbours[i])}};
      };
      const auto u = difference(k, k + 1), v = difference(k + 2, k + 3);
      std::array normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      // A vertex without neighbours along its row or its column has no slope to speak of.
      if (normal[2] == 0) normal = {0, 0, 1};
      const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      const double scale = (normal[2] < 0 ? -1 : 1) / length;
      for (double component : normal) normals.push_back(static_cast<float>(component * scale));
    }
  }
  return normals;
}

}  // namespace scarp
