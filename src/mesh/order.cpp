// Triangles by place, then for the vertex cache (meshoptimizer's Tipsify: Sander, Nehab and Barczak 2007) in chunks of
// them, which are small enough for the processor's own cache, and are the work of many threads.
#ifdef SCARP_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/curve.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "mesh/attributes.h"
#include "scarp/mesh.h"

namespace scarp {

#ifdef SCARP_WITH_MESHOPTIMIZER

namespace {

constexpr std::size_t kChunkTriangles = 1 << 14, kCellTriangles = 64, kPartVertices = 1 << 15;
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr unsigned kCacheSize = 16;

using Corners = std::array<std::uint32_t, 3>;

Corners corners_of(const Mesh& mesh, std::size_t t) {
  return {mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]};
}

/// Where each vertex lies on a curve through cells of the mesh's rectangle.
std::vector<std::uint32_t> curve_places(const Mesh& mesh, int threads, std::size_t& cells) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Box {
    std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  };
  const std::size_t vertices = mesh.vertex_count();
  std::vector<Box> boxes(vertices / kPartVertices + 1);
  parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
    Box box;
    for (std::size_t v = first; v < end; ++v) {
      for (std::size_t k = 0; k < 2; ++k) {
        box.low[k] = std::min(box.low[k], mesh.positions[3 * v + k]);
        box.high[k] = std::max(box.high[k], mesh.positions[3 * v + k]);
      }
    }
    boxes[first / kPartVertices] = box;
  });
  Box whole;
  for (const Box& box : boxes) {
    for (std::size_t k = 0; k < 2; ++k) {
      whole.low[k] = std::min(whole.low[k], box.low[k]);
      whole.high[k] = std::max(whole.high[k], box.high[k]);
    }
  }
  std::size_t side = 1;
  while (side * side * kCellTriangles < mesh.triangle_count()) side *= 2;
  cells = side * side;
  std::array<double, 2> scale;
  for (std::size_t k = 0; k < 2; ++k) {
    const double extent = whole.high[k] - whole.low[k];
    scale[k] = extent > 0 ? static_cast<double>(side) / extent : 0;
  }
  const auto cell = [&](std::size_t v, std::size_t k) {
    const double at = (mesh.positions[3 * v + k] - whole.low[k]) * scale[k];
    return static_cast<std::uint64_t>(std::clamp(at, 0.0, static_cast<double>(side - 1)));
  };
  std::vector<std::uint32_t> places(vertices);
  parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t v = first; v < end; ++v)
      places[v] = static_cast<std::uint32_t>(curve_place(cell(v, 0), cell(v, 1)));
  });
  return places;
}

/// Each triangle at its corner that comes first; those of one cell stay in their order.
std::vector<std::uint32_t> sort_along_curve(const Mesh& mesh, int threads) {
  constexpr std::size_t kMostParts = 8, kLeastTogether = 1 << 16;
  std::size_t cells = 0;
  const std::vector<std::uint32_t> places = curve_places(mesh, threads, cells);
  const auto place_of = [&](std::size_t t) {
    const auto [a, b, c] = corners_of(mesh, t);
    return std::min({places[a], places[b], places[c]});
  };
  // Counters take memory by part, and the order is the same with any number of them.
  const std::size_t count = mesh.triangle_count();
  const std::size_t parts = std::clamp<std::size_t>(static_cast<std::size_t>(thread_count(threads)), 1, kMostParts);
  const std::size_t together = std::max(kLeastTogether, (count + parts - 1) / parts);
  std::vector<std::vector<std::uint32_t>> begins((count + together - 1) / together);
  parallel_for_parts(count, together, threads, [&](std::size_t first, std::size_t end) {
    std::vector<std::uint32_t>& begin = begins[first / together];
    begin.resize(cells);
    for (std::size_t t = first; t < end; ++t) ++begin[place_of(t)];
  });
  std::uint32_t sum = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (auto& begin : begins) sum += std::exchange(begin[cell], sum);
  }
  std::vector<std::uint32_t> sorted;
  resize_large(sorted, mesh.triangles.size(), threads);
  parallel_for_parts(count, together, threads, [&](std::size_t first, std::size_t end) {
    std::vector<std::uint32_t>& begin = begins[first / together];
    for (std::size_t t = first; t < end; ++t) {
      const Corners corners = corners_of(mesh, t);
      std::copy(corners.begin(), corners.end(), sorted.begin() + 3 * std::ptrdiff_t{begin[place_of(t)]++});
    }
  });
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

/// Chunks of triangles that are sorted.
constexpr std::size_t kChunkCorners = 3 * kChunkTriangles;

/// New ids of the vertices, in the order in which the corners first name them; kUnused for those that none does.
/// Returns how many are used.
std::size_t number_by_first_use(std::span<const std::uint32_t> corners, int threads, std::vector<std::uint32_t>& ids) {
  // Who names a vertex first, by chunk; in there all is one thread's.
  std::vector<std::uint32_t> owners(ids.size(), kUnused);
  parallel_for_parts(corners.size(), kChunkCorners, threads, [&](std::size_t first, std::size_t end) {
    const auto chunk = static_cast<std::uint32_t>(first / kChunkCorners);
    for (std::size_t i = first; i < end; ++i) lower_together(owners[corners[i]], chunk);
  });
  std::vector<std::uint32_t> begins(corners.size() / kChunkCorners + 2, 0);
  std::fill(ids.begin(), ids.end(), kUnused);
  parallel_for_parts(corners.size(), kChunkCorners, threads, [&](std::size_t first, std::size_t end) {
    const auto chunk = static_cast<std::uint32_t>(first / kChunkCorners);
    std::uint32_t count = 0;
    for (std::size_t i = first; i < end; ++i) {
      const std::uint32_t v = corners[i];
      if (owners[v] == chunk && ids[v] == kUnused) ids[v] = count++;
    }
    begins[chunk + 1] = count;
  });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  parallel_for_parts(ids.size(), kPartVertices, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t v = first; v < end; ++v) {
      if (owners[v] != kUnused) ids[v] += begins[owners[v]];
    }
  });
  return begins.back();
}

}  // namespace

void optimize_order(Mesh& mesh, int threads) {
  const std::size_t vertices = mesh.vertex_count();
  mesh.triangles = sort_along_curve(mesh, threads);
  std::vector<std::uint32_t>& triangles = mesh.triangles;
  const auto for_each_chunk = [&](const auto& task) {
    parallel_for_parts(triangles.size(), kChunkCorners, threads,
                       [&](std::size_t first, std::size_t end) { task(triangles.data() + first, end - first); });
  };
  for_each_chunk(order_chunk);
  std::vector<std::uint32_t> new_ids(vertices);
  const std::size_t used = number_by_first_use(triangles, threads, new_ids);

  const auto reorder = [&](auto& values, std::size_t width) {
    std::decay_t<decltype(values)> reordered;
    resize_large(reordered, width * used, threads);
    parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
      for (std::size_t v = first; v < end; ++v) {
        if (new_ids[v] == kUnused) continue;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * v), width,
                    reordered.begin() + static_cast<std::ptrdiff_t>(width * new_ids[v]));
      }
    });
    values = std::move(reordered);
  };
  reorder(mesh.positions, 3);
  if (!mesh.normals.empty()) reorder(mesh.normals, 3);
  for_each_attribute(mesh, reorder);
  for_each_chunk([&](std::uint32_t* corners, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) corners[i] = new_ids[corners[i]];
  });
}

#else

void optimize_order(Mesh&, int) {}

#endif

}  // namespace scarp
