#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "mesh/half_edges.h"
#include "scarp/mesh.h"

namespace scarp {
namespace {

constexpr double kMostHeights = 1e6;

/// Traces the lines of one height through the triangles that it crosses.
class ContourTracer {
 public:
  ContourTracer(const Mesh& mesh, const std::vector<std::uint32_t>& twins, std::vector<std::int64_t>& done)
      : mesh_(mesh), twins_(twins), done_(done) {}

  void begin(std::int64_t number, double height) {
    number_ = number;
    height_ = height;
  }

  /// The line through a triangle at this height; empty if the line was found before or is a single point.
  Contour trace(std::uint32_t triangle) {
    Contour line{height_, false, {}};
    if (done_[triangle] == number_) return line;
    const std::uint32_t first = find_start(triangle);
    std::uint32_t entry = first;
    for (;;) {
      add(line.points, entry);
      done_[entry / 3] = number_;
      const std::uint32_t exit = exit_of(entry);
      const std::uint32_t next = twins_[exit];
      if (next == mesh::kNoHalfEdge) {
        add(line.points, exit);
        break;
      }
      if (next == first) {
        line.is_closed = true;
        break;
      }
      entry = next;
    }
    if (line.is_closed && line.points.size() > 1 && line.points.front() == line.points.back()) line.points.pop_back();
    if (line.points.size() < (line.is_closed ? 3u : 2u)) line.points.clear();
    return line;
  }

 private:
  bool is_above(std::uint32_t half_edge) const { return mesh_.vertex(mesh_.triangles[half_edge])[2] >= height_; }

  /// The edge where the line, with higher ground on its left, enters the triangle: the edge that falls below the
  /// height.
  std::uint32_t entry_of(std::uint32_t triangle) const {
    std::uint32_t h = 3 * triangle;
    while (!is_above(h) || is_above(mesh::next_half_edge(h))) h = mesh::next_half_edge(h);
    return h;
  }
  /// The edge that rises above the height.
  std::uint32_t exit_of(std::uint32_t entry) const {
    std::uint32_t h = mesh::next_half_edge(entry);
    while (is_above(h) || !is_above(mesh::next_half_edge(h))) h = mesh::next_half_edge(h);
    return h;
  }

  /// The edge at which the line enters its first triangle: a border edge or, for a closed line, the given triangle's
  /// edge.
  std::uint32_t find_start(std::uint32_t triangle) const {
    const std::uint32_t given = entry_of(triangle);
    std::uint32_t entry = given;
    while (twins_[entry] != mesh::kNoHalfEdge) {
      entry = entry_of(twins_[entry] / 3);
      if (entry == given) break;
    }
    return entry;
  }

  void add(std::vector<std::array<double, 2>>& points, std::uint32_t half_edge) const {
    auto low = mesh_.vertex(mesh_.triangles[half_edge]),
         high = mesh_.vertex(mesh_.triangles[mesh::next_half_edge(half_edge)]);
    if (low[2] > high[2]) std::swap(low, high);
    std::array<double, 2> point{high[0], high[1]};
    if (high[2] != height_) {
      const double part = (height_ - low[2]) / (high[2] - low[2]);
      for (std::size_t k = 0; k < 2; ++k) point[k] = low[k] + (high[k] - low[k]) * part;
    }
    if (points.empty() || points.back() != point) points.push_back(point);
  }

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& twins_;
  std::vector<std::int64_t>& done_;  // for each triangle, the last height already traced through it
  std::int64_t number_ = 0;
  double height_ = 0;
};

/// The smallest k with k · interval > z.
std::int64_t first_above(double z, double interval) {
  double k = std::floor(z / interval) + 1;
  while ((k - 1) * interval > z) --k;
  while (k * interval <= z) ++k;
  return static_cast<std::int64_t>(k);
}

struct CrossedTriangle {
  std::int64_t number;  ///< the height is this multiple of the interval
  std::uint32_t triangle;
};

/// Sorted by height, then by triangle.
std::vector<CrossedTriangle> find_crossed(const Mesh& mesh, double interval) {
  std::vector<CrossedTriangle> crossed;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 3; ++k) {
      const double z = mesh.vertex(mesh.triangles[3 * std::size_t{t} + k])[2];
      low = std::min(low, z);
      high = std::max(high, z);
    }
    const std::int64_t end = first_above(high, interval);
    for (std::int64_t k = first_above(low, interval); k < end; ++k) crossed.push_back({k, t});
  }
  std::stable_sort(crossed.begin(), crossed.end(),
                   [](const CrossedTriangle& a, const CrossedTriangle& b) { return a.number < b.number; });
  return crossed;
}

}  // namespace

Result<std::vector<Contour>> find_contours(const Mesh& mesh, double interval) {
  if (!(interval > 0) || !std::isfinite(interval))
    return fail(ErrorKind::kUsage, fmt::format("the interval of contours is {}, and must be above 0", interval));
  if (mesh.triangles.empty()) return std::vector<Contour>();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    low = std::min(low, mesh.vertex(v)[2]);
    high = std::max(high, mesh.vertex(v)[2]);
  }
  constexpr double kMostMultiple = 1e15;  // integers below are exact doubles
  if ((high - low) / interval > kMostHeights || std::max(std::fabs(low), std::fabs(high)) / interval > kMostMultiple)
    return fail(ErrorKind::kUsage,
                fmt::format("contours every {} between {} and {} are too many: 1,000,000 heights at most", interval,
                            low, high));
  std::vector<Contour> contours;
  const std::vector<std::uint32_t> twins = mesh::build_twins(mesh.triangles);
  std::vector<std::int64_t> done(mesh.triangle_count(), std::numeric_limits<std::int64_t>::min());
  ContourTracer tracer(mesh, twins, done);
  for (const CrossedTriangle& crossed : find_crossed(mesh, interval)) {
    tracer.begin(crossed.number, static_cast<double>(crossed.number) * interval);
    Contour line = tracer.trace(crossed.triangle);
    if (!line.points.empty()) contours.push_back(std::move(line));
  }
  return contours;
}

}  // namespace scarp
