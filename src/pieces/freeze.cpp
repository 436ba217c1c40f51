#include "pieces/freeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "grid/bands.h"
#include "grid/source_failure.h"

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

/// Offsets of lattice points from the frame's origin, in double; a few thousand at a time, since double arrays of a
/// whole mesh would be the peak of memory.
class OffsetMap {
 public:
  OffsetMap(std::int32_t cols, std::int32_t rows, const Frame& frame, std::int32_t steps)
      : frame_(frame), steps_(steps), col0_(cols / 2), row0_(rows / 2), origin_(frame_origin(frame, cols, rows)) {}

  std::array<double, 2> origin() const { return origin_; }

  /// Fills x and y for a chunk of points.
  void map(std::span<const Point> points, std::vector<double>& x, std::vector<double>& y) const {
    x.clear();
    y.clear();
    for (Point p : points) {
      // In affine frames from differences of indices, so that offsets that are float32 by construction come out
      // exactly.
      const auto& a = frame_.affine;
      const double col = p.x / steps_, row = p.y / steps_, i = col - col0_, j = row - row0_;
      const std::array<double, 2> at =
          frame_.is_affine() ? std::array{a[1] * i + a[2] * j, a[4] * i + a[5] * j} : frame_.apply_affine(col, row);
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
  double steps_;
  std::int32_t col0_, row0_;
  std::array<double, 2> origin_;
};

constexpr std::size_t kChunkVertices = 4096;

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
  std::vector<double> x, y;
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (numbers.of(v) != kNone) {
      vertices.push_back(v);
      chunk.push_back(tin.point(v));
    }
    if (chunk.size() < kChunkVertices && v + 1 < tin.vertex_count()) continue;
    offsets.map(chunk, x, y);
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      for (double offset : {x[k], y[k]})
        mesh.positions.push_back(round_to_float32 ? static_cast<float>(offset) : offset);
      mesh.positions.push_back(lattice.are_samples() ? heights.at_vertex(vertices[k], chunk[k])
                                                     : lattice.heights[vertices[k]]);
    }
    vertices.clear();
    chunk.clear();
  }
  mesh.origin = {offsets.origin()[0], offsets.origin()[1], 0};
}

/// Triangles are positive on the lattice; where the frame turns them over they are turned back.
void face_up(const Frame& frame, Mesh& mesh) {
  if (frame.is_affine() ? frame.determinant() > 0 : twice_area(mesh) >= 0) return;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
}

/// Samples that are in memory for now, of a raster with `rows` rows.
struct Surroundings {
  const RowRange& held;
  std::int32_t rows;

  std::int32_t cols() const { return held.samples.cols; }
  float at(Point p) const { return held.row(p.y)[p.x]; }
  bool is_usable(Point p) const { return p.x >= 0 && p.y >= 0 && p.x < cols() && p.y < rows && !std::isnan(at(p)); }
};

/// At samples.
std::vector<float> normals_at_samples(const Surroundings& heights, const Frame& frame, std::span<const Point> samples) {
  const OffsetMap offsets(heights.cols(), heights.rows, frame, 1);
  std::vector<float> normals;
  normals.reserve(3 * samples.size());
  std::vector<Point> neighbours;  // west, east, north, south of each vertex; a missing one is the vertex itself
  std::vector<double> x, y;
  for (std::size_t begin = 0; begin < samples.size(); begin += kChunkVertices) {
    neighbours.clear();
    for (Point p : samples.subspan(begin, std::min(kChunkVertices, samples.size() - begin))) {
      for (Point q : {Point{p.x - 1, p.y}, Point{p.x + 1, p.y}, Point{p.x, p.y - 1}, Point{p.x, p.y + 1}})
        neighbours.push_back(heights.is_usable(q) ? q : p);
    }
    offsets.map(neighbours, x, y);
    for (std::size_t k = 0; k < neighbours.size(); k += 4) {
      const auto difference = [&](std::size_t i, std::size_t j) {
        return std::array{x[j] - x[i], y[j] - y[i],
                          double{heights.at(neighbours[j])} - double{heights.at(neighbours[i])}};
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

/// The valid ones of the up to four samples around a point, with their bilinear weights.
void add_corners(const Surroundings& heights, std::int32_t steps, Point p, std::vector<Point>& corners,
                 std::vector<double>& weights) {
  const Point first{p.x / steps, p.y / steps};
  const double u = static_cast<double>(p.x % steps) / steps, v = static_cast<double>(p.y % steps) / steps;
  for (const std::int32_t dy : {0, 1}) {
    for (const std::int32_t dx : {0, 1}) {
      const double weight = (dx == 0 ? 1 - u : u) * (dy == 0 ? 1 - v : v);
      const Point corner{first.x + dx, first.y + dy};
      if (weight == 0 || !heights.is_usable(corner)) continue;
      corners.push_back(corner);
      weights.push_back(weight);
    }
  }
}

std::vector<float> normals_at(const Surroundings& heights, const Frame& frame, std::int32_t steps,
                              std::span<const Point> points) {
  if (steps == 1) return normals_at_samples(heights, frame, points);
  std::vector<float> normals;
  normals.reserve(3 * points.size());
  std::vector<Point> corners;  // the valid samples around each point
  std::vector<double> weights;
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunkVertices) {
    corners.clear();
    weights.clear();
    ends.clear();
    for (Point p : points.subspan(begin, std::min(kChunkVertices, points.size() - begin))) {
      add_corners(heights, steps, p, corners, weights);
      ends.push_back(corners.size());
    }
    const std::vector<float> around = normals_at_samples(heights, frame, corners);
    std::size_t corner = 0;
    for (const std::size_t end : ends) {
      std::array<double, 3> sum{0, 0, 0};
      for (; corner < end; ++corner) {
        for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[corner] * double{around[3 * corner + k]};
      }
      if (sum[2] == 0) sum = {0, 0, 1};
      const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      for (const double component : sum) normals.push_back(static_cast<float>(component / length));
    }
  }
  return normals;
}

/// Indices of points, in the order of the rows of samples at or above them.
std::vector<std::uint32_t> order_by_row(const LatticePoints& at) {
  std::vector<std::uint32_t> order(at.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto row = [&](std::uint32_t k) { return at.points[k].y / at.steps; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(row(a), a) < std::pair(row(b), b); });
  return order;
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

std::vector<float> sample_normals(const HeightField& field, const LatticePoints& at) {
  constexpr std::int32_t kReach = 2;  // of the samples around the one below a point
  std::vector<float> normals;
  std::vector<std::uint32_t> order;
  std::vector<Point> points;
  std::size_t next = 0;
  const auto swept = sweep_rows(field, kReach, [&](const RowRange& rows) -> Result<void> {
    const Surroundings heights{rows, field.rows};
    if (rows.begin == 0 && rows.end == field.rows) {
      normals = normals_at(heights, field.frame, at.steps, at.points);
      return {};
    }
    if (rows.begin == 0) {
      order = order_by_row(at);
      normals.resize(3 * order.size());
    }
    const std::size_t first = next;
    points.clear();
    for (; next < order.size() && at.points[order[next]].y / at.steps < rows.end; ++next)
      points.push_back(at.points[order[next]]);
    const std::vector<float> here = normals_at(heights, field.frame, at.steps, points);
    for (std::size_t k = 0; k < here.size(); ++k) normals[3 * order[first + k / 3] + k % 3] = here[k];
    return {};
  });
  if (!swept) throw SourceFailure{swept.error()};
  return normals;
}

}  // namespace scarp
