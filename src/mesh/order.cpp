// Sorts triangles by place, then in chunks for the vertex cache (meshoptimizer's Tipsify: Sander, Nehab and Barczak
// 2007). Chunks fit the processor's cache and are distributed over threads.
#include "mesh/order.h"

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

namespace {

constexpr std::size_t kPartVertices = 1 << 15;
constexpr std::uint32_t kUnused = mesh::VertexNumbers::kUnused;

}  // namespace

mesh::VertexNumbers mesh::number_used(std::span<const std::uint32_t> corners, std::size_t vertices) {
  VertexNumbers numbers{std::vector<std::uint32_t>(vertices, kUnused)};
  for (const std::uint32_t v : corners) numbers.ids[v] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t& id : numbers.ids) {
    if (id != kUnused) id = count++;
  }
  numbers.count = count;
  return numbers;
}

#ifdef SCARP_WITH_MESHOPTIMIZER

namespace {

constexpr std::size_t kChunkTriangles = 1 << 14, kCellTriangles = 64;
constexpr unsigned kCacheSize = 16;

/// The position of each vertex along a curve through `side` × `side` cells of the bounding rectangle.
std::vector<std::uint32_t> curve_places(std::size_t vertices, mesh::FindPlaces find_places, std::size_t side,
                                        int threads) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t kAtOnce = 4096;
  struct Box {
    std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  };
  const auto each_place = [&](std::size_t first, std::size_t end, const auto& visit) {
    std::vector<std::array<double, 2>> places(std::min(kAtOnce, end - first));
    for (; first < end; first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, end - first);
      find_places(first, first + count, std::span(places).first(count));
      for (std::size_t i = 0; i < count; ++i) visit(first + i, places[i]);
    }
  };
  std::vector<Box> boxes(vertices / kPartVertices + 1);
  parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
    Box box;
    each_place(first, end, [&](std::size_t, const std::array<double, 2>& place) {
      for (std::size_t k = 0; k < 2; ++k) {
        box.low[k] = std::min(box.low[k], place[k]);
        box.high[k] = std::max(box.high[k], place[k]);
      }
    });
    boxes[first / kPartVertices] = box;
  });
  Box whole;
  for (const Box& box : boxes) {
    for (std::size_t k = 0; k < 2; ++k) {
      whole.low[k] = std::min(whole.low[k], box.low[k]);
      whole.high[k] = std::max(whole.high[k], box.high[k]);
    }
  }
  std::array<double, 2> scale;
  for (std::size_t k = 0; k < 2; ++k) {
    const double extent = whole.high[k] - whole.low[k];
    scale[k] = extent > 0 ? static_cast<double>(side) / extent : 0;
  }
  std::vector<std::uint32_t> on_curve(vertices);
  parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
    each_place(first, end, [&](std::size_t v, const std::array<double, 2>& place) {
      const auto cell = [&](std::size_t k) {
        const double at = (place[k] - whole.low[k]) * scale[k];
        return at > 0 ? static_cast<std::uint64_t>(std::min(at, static_cast<double>(side - 1))) : 0;  // 0 for NaN
      };
      on_curve[v] = static_cast<std::uint32_t>(curve_place(cell(0), cell(1)));
    });
  });
  return on_curve;
}

}  // namespace

// Triangles are sorted by their first corner along the curve; triangles of one cell keep their order.
std::vector<std::uint32_t> mesh::sort_by_place(std::span<const std::uint32_t> corners, std::size_t vertices,
                                               FindPlaces find_places, int threads) {
  constexpr std::size_t kMostParts = 8, kLeastTogether = 1 << 16;
  const std::size_t count = corners.size() / 3;
  std::size_t side = 1;
  while (side * side * kCellTriangles < count) side *= 2;
  const std::size_t cells = side * side;
  const std::vector<std::uint32_t> places = curve_places(vertices, find_places, side, threads);
  const auto place_of = [&](std::size_t t) {
    return std::min({places[corners[3 * t]], places[corners[3 * t + 1]], places[corners[3 * t + 2]]});
  };
  // Counters need memory per part; the order does not depend on the number of parts.
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
  resize_large(sorted, corners.size(), threads);
  parallel_for_parts(count, together, threads, [&](std::size_t first, std::size_t end) {
    std::vector<std::uint32_t>& begin = begins[first / together];
    for (std::size_t t = first; t < end; ++t)
      std::copy_n(corners.data() + 3 * t, 3, sorted.data() + 3 * std::size_t{begin[place_of(t)]++});
  });
  return sorted;
}

namespace {

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

/// Chunks of triangles to sort.
constexpr std::size_t kChunkCorners = 3 * kChunkTriangles;

/// New ids of the vertices, in the order of their first use by corners; kUnused for unused vertices. Returns the number
/// of used vertices.
std::size_t number_by_first_use(std::span<const std::uint32_t> corners, int threads, std::vector<std::uint32_t>& ids) {
  // For each vertex, the first chunk that uses it; one thread numbers the vertices of a chunk.
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

mesh::VertexNumbers mesh::sort_for_cache(std::vector<std::uint32_t>& corners, std::size_t vertices, int threads) {
  const auto for_each_chunk = [&](const auto& task) {
    parallel_for_parts(corners.size(), kChunkCorners, threads,
                       [&](std::size_t first, std::size_t end) { task(corners.data() + first, end - first); });
  };
  for_each_chunk(order_chunk);
  VertexNumbers numbers{std::vector<std::uint32_t>(vertices)};
  numbers.count = number_by_first_use(corners, threads, numbers.ids);
  for_each_chunk([&](std::uint32_t* chunk, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) chunk[i] = numbers.ids[chunk[i]];
  });
  return numbers;
}

#else

std::vector<std::uint32_t> mesh::sort_by_place(std::span<const std::uint32_t> corners, std::size_t, FindPlaces, int) {
  return {corners.begin(), corners.end()};
}

mesh::VertexNumbers mesh::sort_for_cache(std::vector<std::uint32_t>& corners, std::size_t vertices, int) {
  VertexNumbers numbers{std::vector<std::uint32_t>(vertices, kUnused)};
  for (std::uint32_t& corner : corners) {
    std::uint32_t& id = numbers.ids[corner];
    if (id == kUnused) id = static_cast<std::uint32_t>(numbers.count++);
    corner = id;
  }
  return numbers;
}

#endif

void optimize_order(Mesh& mesh, int threads) {
  const std::size_t vertices = mesh.vertex_count();
  const auto find_places = [&](std::size_t first, std::size_t end, std::span<std::array<double, 2>> places) {
    for (std::size_t v = first; v < end; ++v) places[v - first] = {mesh.positions[3 * v], mesh.positions[3 * v + 1]};
  };
  mesh.triangles = mesh::sort_by_place(mesh.triangles, vertices, find_places, threads);
  const mesh::VertexNumbers numbers = mesh::sort_for_cache(mesh.triangles, vertices, threads);

  const auto reorder = [&](auto& values, std::size_t width) {
    std::decay_t<decltype(values)> reordered;
    resize_large(reordered, width * numbers.count, threads);
    parallel_for_parts(vertices, kPartVertices, threads, [&](std::size_t first, std::size_t end) {
      for (std::size_t v = first; v < end; ++v) {
        if (numbers.ids[v] == kUnused) continue;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * v), width,
                    reordered.begin() + static_cast<std::ptrdiff_t>(width * numbers.ids[v]));
      }
    });
    values = std::move(reordered);
  };
  reorder(mesh.positions, 3);
  if (!mesh.normals.empty()) reorder(mesh.normals, 3);
  mesh::for_each_attribute(mesh, reorder);
}

}  // namespace scarp
