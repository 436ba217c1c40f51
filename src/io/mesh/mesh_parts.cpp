#include "io/mesh/mesh_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"

namespace scarp::io {
namespace {

constexpr std::size_t kMostVertices = 65535;
/// Triangles per task when several threads halve one share.
constexpr std::size_t kTogether = 1 << 16;

/// Indices of vertices in the current part: an open-addressing hash table.
class Places {
 public:
  Places() { slots_.resize(kSlots, {kFree, 0}); }

  /// The index of the vertex. A new one is appended to `vertices`.
  std::uint32_t find(std::uint32_t vertex, std::vector<std::uint32_t>& vertices) {
    std::size_t i = vertex * 0x9e3779b1u >> kShift;
    while (slots_[i].vertex != vertex && slots_[i].vertex != kFree) i = (i + 1) & (kSlots - 1);
    if (slots_[i].vertex == kFree) {
      slots_[i] = {vertex, static_cast<std::uint32_t>(vertices.size())};
      vertices.push_back(vertex);
    }
    return slots_[i].place;
  }

 private:
  static constexpr std::size_t kSlots = std::size_t{1} << 17;  // nearly twice the largest number of vertices
  static constexpr unsigned kShift = 32 - std::countr_zero(kSlots);
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  struct Slot {
    std::uint32_t vertex, place;
  };
  std::vector<Slot> slots_;
};

/// A set of triangles that becomes a part or is halved.
struct Share {
  std::size_t first = 0, count = 0;
  std::optional<MeshPart> part = {};
};

class Splitter {
 public:
  Splitter(const Mesh& mesh, int threads) : mesh_(mesh), threads_(thread_count(threads)), ids_(mesh.triangle_count()) {
    std::iota(ids_.begin(), ids_.end(), 0);
  }

  /// Halves shares until none is too large.
  std::vector<MeshPart> split() {
    std::vector<Share> shares{{0, ids_.size()}};
    const auto is_made = [](const Share& share) { return share.part.has_value(); };
    while (!std::all_of(shares.begin(), shares.end(), is_made)) {
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < shares.size(); ++i) {
        if (!is_made(shares[i])) open.push_back(i);
      }
      std::vector<std::size_t> middles(shares.size(), 0);
      const int each = std::max(1, threads_ / static_cast<int>(std::min<std::size_t>(open.size(), 1 << 16)));
      parallel_for(open.size(), threads_, [&](std::size_t k) {
        Share& share = shares[open[k]];
        share.part = make_part(triangles_of(share));
        if (!share.part) middles[open[k]] = halve(share, each);
      });
      std::vector<Share> next;
      for (std::size_t i = 0; i < shares.size(); ++i) {
        Share& share = shares[i];
        if (is_made(share)) {
          next.push_back(std::move(share));
          continue;
        }
        next.push_back({share.first, middles[i]});
        next.push_back({share.first + middles[i], share.count - middles[i]});
      }
      shares = std::move(next);
    }
    std::vector<MeshPart> parts;
    for (Share& share : shares) parts.push_back(std::move(*share.part));
    return parts;
  }

 private:
  std::span<std::uint32_t> triangles_of(const Share& share) {
    return std::span(ids_).subspan(share.first, share.count);
  }

  /// Nothing if the triangles have too many vertices.
  std::optional<MeshPart> make_part(std::span<const std::uint32_t> triangles) const {
    MeshPart part;
    Places places;
    part.corners.reserve(std::min(3 * triangles.size(), 6 * kMostVertices));
    for (const std::uint32_t t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[3 * std::size_t{t} + k];
        part.corners.push_back(static_cast<std::uint16_t>(places.find(v, part.vertices)));
      }
      if (part.vertices.size() > kMostVertices) return std::nullopt;
    }
    return part;
  }

  /// Three times the centre of a triangle.
  double centre(std::uint32_t triangle, std::size_t axis) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += mesh_.positions[3 * std::size_t{mesh_.triangles[3 * std::size_t{triangle} + k]} + axis];
    return sum;
  }

  struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(const Extent& other) {
      low = std::min(low, other.low);
      high = std::max(high, other.high);
    }
  };

  /// Extents of the centres along both axes.
  std::array<Extent, 2> extents_of(std::span<const std::uint32_t> triangles, int threads) const {
    std::vector<std::array<Extent, 2>> parts(triangles.size() / kTogether + 1);
    parallel_for_parts(triangles.size(), kTogether, threads, [&](std::size_t first, std::size_t end) {
      std::array<Extent, 2> extents;
      for (std::size_t i = first; i < end; ++i) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double at = centre(triangles[i], axis);
          extents[axis].add({at, at});
        }
      }
      parts[first / kTogether] = extents;
    });
    std::array<Extent, 2> whole;
    for (const auto& part : parts) {
      for (std::size_t axis = 0; axis < 2; ++axis) whole[axis].add(part[axis]);
    }
    return whole;
  }

  /// Moves the triangles on one side of the median to the front, in order. Returns their number.
  std::size_t halve(const Share& share, int threads) {
    const std::span<std::uint32_t> triangles = triangles_of(share);
    const std::array<Extent, 2> extents = extents_of(triangles, threads);
    const std::size_t axis = extents[1].high - extents[1].low > extents[0].high - extents[0].low ? 1 : 0;
    const std::size_t count = triangles.size();
    std::vector<double> centres(count);
    parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) centres[i] = centre(triangles[i], axis);
    });
    const double median = median_of(centres, extents[axis], threads);
    std::vector<std::size_t> fronts(count / kTogether + 2, 0);
    parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
      std::size_t front = 0;
      for (std::size_t i = first; i < end; ++i) front += centres[i] < median;
      fronts[first / kTogether + 1] = front;
    });
    std::partial_sum(fronts.begin(), fronts.end(), fronts.begin());
    const std::size_t middle = fronts.back();
    if (middle == 0) return count / 2;  // no centre is below the median
    std::vector<std::uint32_t> sides(count);
    parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
      std::size_t front = fronts[first / kTogether], back = middle + first - front;
      for (std::size_t i = first; i < end; ++i) sides[centres[i] < median ? front++ : back++] = triangles[i];
    });
    std::copy(sides.begin(), sides.end(), triangles.begin());
    return middle;
  }

  /// The median. The values are in ordered buckets, so only one bucket is searched.
  static double median_of(std::span<const double> centres, const Extent& extent, int threads) {
    constexpr std::size_t kBuckets = 1024;
    const double scale = extent.high > extent.low ? (kBuckets - 1) / (extent.high - extent.low) : 0;
    const auto bucket_of = [&](double centre) { return static_cast<std::size_t>((centre - extent.low) * scale); };
    std::vector<std::array<std::size_t, kBuckets>> parts(centres.size() / kTogether + 1);
    parallel_for_parts(centres.size(), kTogether, threads, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) ++parts[first / kTogether][bucket_of(centres[i])];
    });
    std::size_t rank = centres.size() / 2, bucket = 0;
    for (;; ++bucket) {
      std::size_t inside = 0;
      for (const auto& counts : parts) inside += counts[bucket];
      if (rank < inside) break;
      rank -= inside;
    }
    std::vector<double> near;
    for (const double centre : centres) {
      if (bucket_of(centre) == bucket) near.push_back(centre);
    }
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(near.begin(), middle, near.end());
    return *middle;
  }

  const Mesh& mesh_;
  int threads_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace

std::vector<MeshPart> split_mesh(const Mesh& mesh, int threads) {
  if (mesh.vertex_count() > kMostVertices) return Splitter(mesh, threads).split();
  MeshPart whole;
  whole.vertices.resize(mesh.vertex_count());
  std::iota(whole.vertices.begin(), whole.vertices.end(), 0);
  whole.corners.assign(mesh.triangles.begin(), mesh.triangles.end());
  return {std::move(whole)};
}

}  // namespace scarp::io
