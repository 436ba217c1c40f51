#include "pieces/freeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "grid/source_failure.h"
#include "pieces/offset_map.h"

namespace scarp::pieces {

namespace {

constexpr std::size_t kPartVertices = 4 * kChunkVertices, kPartTriangles = 1 << 15;

/// Computes positions of many vertices at a time.
class PositionMaker {
 public:
  PositionMaker(const tin::Triangulation& tin, const VertexPositions& way)
      : tin_(tin), way_(way), offsets_(way.heights.cols(), way.heights.rows(), way.frame, way.lattice.steps) {}

  std::array<double, 3> origin() const { return offsets_.origin(); }

  /// Calls put(vertex, {x, y, z}) for the vertices in [first, end) with is_used(vertex).
  template <class IsUsed, class Put>
  void each(std::size_t first, std::size_t end, const IsUsed& is_used, const Put& put) const {
    std::vector<tin::Vertex> vertices;
    std::vector<Point> chunk;
    std::vector<double> x, y, z;
    const std::size_t most = std::min(end - first, kChunkVertices);
    vertices.reserve(most);
    chunk.reserve(most);
    z.reserve(most);
    for (std::size_t i = first; i < end; ++i) {
      const auto vertex = static_cast<tin::Vertex>(i);
      if (is_used(vertex)) {
        vertices.push_back(vertex);
        chunk.push_back(tin_.point(vertex));
      }
      if (chunk.size() < kChunkVertices && i + 1 < end) continue;
      z.clear();
      for (std::size_t k = 0; k < chunk.size(); ++k) z.push_back(height(vertices[k], chunk[k]));
      offsets_.map(chunk, x, y, z);
      for (std::vector<double>* offsets : {&x, &y, &z}) round(*offsets);
      for (std::size_t k = 0; k < chunk.size(); ++k) put(vertices[k], std::array{x[k], y[k], z[k]});
      vertices.clear();
      chunk.clear();
    }
  }
  /// Calls put() for all vertices, on several threads in affine frames.
  template <class IsUsed, class Put>
  void each_of_all(const IsUsed& is_used, int threads, const Put& put) const {
    const std::size_t count = tin_.vertex_count();
    if (!way_.frame.is_affine() || !way_.heights.are_in_memory()) return each(0, count, is_used, put);
    parallel_for_parts(count, kPartVertices, threads,
                       [&](std::size_t first, std::size_t end) { each(first, end, is_used, put); });
  }
  /// Computes x and y. REQUIRES: an affine frame.
  void find_places(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places) const {
    std::vector<Point> chunk;
    std::vector<double> x, y, none;
    chunk.reserve(end - first);
    for (std::size_t i = first; i < end; ++i) chunk.push_back(tin_.point(static_cast<tin::Vertex>(i)));
    offsets_.map(chunk, x, y, none);
    for (std::vector<double>* offsets : {&x, &y}) round(*offsets);
    for (std::size_t k = 0; k < chunk.size(); ++k) places[k] = {x[k], y[k]};
  }

 private:
  /// One array at a time: if rounding is conditional, g++ 12 vectorizes a vertex' x and y without rounding.
  void round(std::vector<double>& offsets) const {
    if (!way_.round_to_float32) return;
    for (double& offset : offsets) offset = static_cast<float>(offset);
  }
  float height(tin::Vertex v, Point p) const {
    return way_.lattice.are_samples() ? way_.heights.at_vertex(v, p) : way_.lattice.heights[v];
  }

  const tin::Triangulation& tin_;
  const VertexPositions& way_;
  OffsetMap offsets_;
};

/// Twice the area projected along `up`.
double twice_area(std::span<const tin::Vertex> corners, const std::vector<double>& positions,
                  const std::array<double, 3>& up) {
  double sum = 0;
  for (std::size_t h = 0; h < corners.size(); h += 3) {
    const double* a = &positions[3 * std::size_t{corners[h]}];
    const double* b = &positions[3 * std::size_t{corners[h + 1]}];
    const double* c = &positions[3 * std::size_t{corners[h + 2]}];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (up[k] != 0) sum += up[k] * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
    }
  }
  return sum;
}

/// Makes triangles, which are positive on the lattice, counter-clockwise if the frame mirrors them. `positions`: of the
/// vertices; unused in affine frames.
void face_up(const Frame& frame, const std::vector<double>& positions, int threads, std::span<tin::Vertex> corners) {
  const std::array<double, 3> up = frame.space ? frame.space->up() : std::array<double, 3>{0, 0, 1};
  if (frame.is_affine() ? frame.determinant() > 0 : twice_area(corners, positions, up) >= 0) return;
  parallel_for_parts(corners.size(), 3 * kPartTriangles, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t h = first; h < end; h += 3) std::swap(corners[h + 1], corners[h + 2]);
  });
}

void put_position(const std::array<double, 3>& position, std::size_t at, std::vector<double>& positions) {
  std::copy(position.begin(), position.end(), positions.begin() + 3 * static_cast<std::ptrdiff_t>(at));
}

}  // namespace

float SampleHeights::at(Point p) const {
  if (source_ == nullptr) return raster_.at(p);
  float height = 0;
  if (auto read = source_->read(p.x, p.y, 1, 1, &height, 1); !read) throw grid::SourceFailure{read.error()};
  return height;
}

Mesh freeze(const tin::Triangulation& tin, const VertexPositions& way, int threads) {
  Mesh mesh;
  std::vector<std::uint32_t>& triangles = mesh.triangles;
  std::size_t count = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) count += !tin.is_outside(t);
  triangles.reserve(3 * count);
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) triangles.push_back(tin.origin(h));
  }
  const mesh::VertexNumbers numbers = mesh::number_used(triangles, tin.vertex_count());
  for (std::uint32_t& corner : triangles) corner = numbers.ids[corner];
  const PositionMaker maker(tin, way);
  mesh.origin = maker.origin();
  resize_large(mesh.positions, 3 * numbers.count, threads);
  const auto is_used = [&](tin::Vertex v) { return numbers.ids[v] != mesh::VertexNumbers::kUnused; };
  maker.each_of_all(is_used, threads, [&](tin::Vertex v, const std::array<double, 3>& position) {
    put_position(position, numbers.ids[v], mesh.positions);
  });
  face_up(way.frame, mesh.positions, threads, triangles);
  return mesh;
}

LatticePoints frozen_points(const tin::Triangulation& tin, const grid::VertexLattice& lattice) {
  std::vector<std::uint8_t> are_used(tin.vertex_count(), 0);
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) are_used[tin.origin(h)] = 1;
  }
  LatticePoints at{lattice.steps, {}};
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (are_used[v] != 0) at.points.push_back(tin.point(v));
  }
  return at;
}

MeltDown::MeltDown(tin::Triangulation tin, const VertexPositions& way, int threads)
    : tin_(std::move(tin)), way_(way), threads_(threads) {
  tin_.drop_links();
  const std::size_t all = tin_.triangle_count();
  corners_ = tin_.take_corners();
  const std::span<tin::Vertex> corners(corners_.data(), corners_.size());
  if (triangle_count() < all) numbers_ = mesh::number_used(corners, tin_.vertex_count());
  if (!way_.frame.is_affine()) {
    resize_large(positions_, 3 * tin_.vertex_count(), threads_);
    PositionMaker(tin_, way_)
        .each_of_all(
            [this](tin::Vertex v) { return is_used(v); }, threads_,
            [this](tin::Vertex v, const std::array<double, 3>& position) { put_position(position, v, positions_); });
  }
  face_up(way_.frame, positions_, threads_, corners);
}

void MeltDown::find_places(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (positions_.empty()) PositionMaker(tin_, way_).find_places(first, end, places);
  for (std::size_t v = first; v < end; ++v) {
    if (!positions_.empty()) places[v - first] = {positions_[3 * v], positions_[3 * v + 1]};
    if (!is_used(static_cast<tin::Vertex>(v))) places[v - first] = {kNaN, kNaN};
  }
}

void MeltDown::order() {
  const std::size_t vertices = tin_.vertex_count();
  ordered_ = mesh::sort_by_place(
      {corners_.data(), corners_.size()}, vertices,
      [this](std::size_t first, std::size_t end, auto places) { find_places(first, end, places); }, threads_);
  corners_.release();
  numbers_ = mesh::sort_for_cache(ordered_, vertices, threads_);
}

Mesh MeltDown::finish() {
  Mesh mesh;
  if (ordered_.empty()) {
    ordered_.assign(corners_.begin(), corners_.end());
    corners_.release();
    for (std::size_t i = 0; numbers_ && i < ordered_.size(); ++i) ordered_[i] = numbers_->ids[ordered_[i]];
  }
  mesh.triangles = std::move(ordered_);
  const PositionMaker maker(tin_, way_);
  mesh.origin = maker.origin();
  resize_large(mesh.positions, 3 * vertex_count(), threads_);
  const auto put = [&](tin::Vertex v, const std::array<double, 3>& position) {
    put_position(position, number(v), mesh.positions);
  };
  if (positions_.empty()) {
    maker.each_of_all([this](tin::Vertex v) { return is_used(v); }, threads_, put);
  } else {
    for (tin::Vertex v = 0; v < tin_.vertex_count(); ++v) {
      const double* at = &positions_[3 * std::size_t{v}];
      if (is_used(v)) put(v, {at[0], at[1], at[2]});
    }
    std::vector<double>().swap(positions_);
  }
  return mesh;
}

LatticePoints MeltDown::points() const {
  LatticePoints at{way_.lattice.steps, {}};
  at.points.resize(vertex_count());
  for (tin::Vertex v = 0; v < tin_.vertex_count(); ++v) {
    if (is_used(v)) at.points[number(v)] = tin_.point(v);
  }
  return at;
}

void round_heights(Mesh& mesh, double step) {
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3)
    mesh.positions[i] = std::nearbyint(mesh.positions[i] / step) * step;
}

}  // namespace scarp::pieces
