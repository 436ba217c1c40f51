// Triangles by place, then for the vertex cache (meshoptimizer's Tipsify: Sander, Nehab and Barczak 2007) in chunks of
// them, which are small enough for the processor's own cache, and are the work of many threads.
#ifdef SCARP_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/curve.h"
#include "base/parallel.h"
#include "mesh/attributes.h"
#include "scarp/mesh.h"

namespace scarp {

#ifdef SCARP_WITH_MESHOPTIMIZER

namespace {

constexpr std::size_t kChunkTriangles = 1 << 14, kCellTriangles = 64;
constexpr unsigned kCacheSize = 16;

using Corners = std::array<std::uint32_t, 3>;

Corners corners_of(const Mesh& mesh, std::size_t t) {
  return {mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]};
}

/// Where each vertex lies on a curve through cells of the mesh's rectangle.
std::vector<std::uint32_t> curve_places(const Mesh& mesh, std::size_t& cells) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], mesh.positions[3 * v + k]);
      high[k] = std::max(high[k], mesh.positions[3 * v + k]);
    }
  }
  std::size_t side = 1;
  while (side * side * kCellTriangles < mesh.triangle_count()) side *= 2;
  cells = side * side;
  std::array<double, 2> scale;
  for (std::size_t k = 0; k < 2; ++k) scale[k] = high[k] > low[k] ? static_cast<double>(side) / (high[k] - low[k]) : 0;
  const auto cell = [&](std::size_t v, std::size_t k) {
    const double at = (mesh.positions[3 * v + k] - low[k]) * scale[k];
    return static_cast<std::uint64_t>(std::clamp(at, 0.0, static_cast<double>(side - 1)));
  };
  std::vector<std::uint32_t> places(mesh.vertex_count());
  for (std::size_t v = 0; v < places.size(); ++v)
    places[v] = static_cast<std::uint32_t>(curve_place(cell(v, 0), cell(v, 1)));
  return places;
}

/// Each triangle at its corner that comes first; those of one cell stay in their order.
std::vector<std::uint32_t> sort_along_curve(const Mesh& mesh) {
  std::size_t cells = 0;
  const std::vector<std::uint32_t> places = curve_places(mesh, cells);
  const auto place_of = [&](std::size_t t) {
    const auto [a, b, c] = corners_of(mesh, t);
    return std::min({places[a], places[b], places[c]});
  };
  std::vector<std::uint32_t> begin(cells + 1);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) ++begin[place_of(t) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<std::uint32_t> sorted(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Corners corners = corners_of(mesh, t);
    std::copy(corners.begin(), corners.end(), sorted.begin() + 3 * std::ptrdiff_t{begin[place_of(t)]++});
  }
  return sorted;
}

/// Vertices of a chunk, numbered by first use.
class LocalIds {
 public:
  explicit LocalIds(std::size_t corners) {
    while (slots_.size() < 2 * corners) slots_.resize(std::max<std::size_t>(2 * slots_.size(), 64), kFree);
    places_.resize(slots_.size());
  }

  std::uint32_t of(std::uint32_t vertex) {
    std::size_t slot = vertex * 0x9e3779b1u & (slots_.size() - 1);
    while (slots_[slot] != vertex && slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == kFree) {
      slots_[slot] = vertex;
      places_[slot] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(vertex);
    }
    return places_[slot];
  }
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> slots_, places_, vertices_;
};

void order_chunk(std::uint32_t* corners, std::size_t count) {
  LocalIds ids(count);
  std::vector<std::uint32_t> local(count), ordered(count);
  for (std::size_t i = 0; i < count; ++i) local[i] = ids.of(corners[i]);
  meshopt_optimizeVertexCacheFifo(ordered.data(), local.data(), count, ids.vertices().size(), kCacheSize);
  for (std::size_t i = 0; i < count; ++i) corners[i] = ids.vertices()[ordered[i]];
}

}  // namespace

void optimize_order(Mesh& mesh, int threads) {
  const std::size_t vertices = mesh.vertex_count();
  std::vector<std::uint32_t> triangles = sort_along_curve(mesh);
  const std::size_t chunk = 3 * kChunkTriangles;
  const auto for_each_chunk = [&](const auto& task) {
    parallel_for((triangles.size() + chunk - 1) / chunk, threads, [&](std::size_t i) {
      task(triangles.data() + i * chunk, std::min(chunk, triangles.size() - i * chunk));
    });
  };
  for_each_chunk(order_chunk);
  std::vector<std::uint32_t> new_ids(vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_ids.data(), triangles.data(), triangles.size(), vertices);

  const auto reorder = [&](auto& values, std::size_t width) {
    std::decay_t<decltype(values)> reordered(width * used);
    for (std::size_t v = 0; v < vertices; ++v) {
      if (new_ids[v] == std::numeric_limits<std::uint32_t>::max()) continue;
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * v), width,
                  reordered.begin() + static_cast<std::ptrdiff_t>(width * new_ids[v]));
    }
    values = std::move(reordered);
  };
  reorder(mesh.positions, 3);
  if (!mesh.normals.empty()) reorder(mesh.normals, 3);
  for_each_attribute(mesh, reorder);
  for_each_chunk([&](std::uint32_t* corners, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) corners[i] = new_ids[corners[i]];
  });
  mesh.triangles = std::move(triangles);
}

#else

void optimize_order(Mesh&, int) {}

#endif

}  // namespace scarp
