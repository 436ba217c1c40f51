// Pairs of triangles that overlap seen from above.
//
// Two convex polygons have disjoint interiors exactly if one polygon lies beyond a side of the other (separating axis).
// Pairs are searched in a bucket grid with about two triangles per bucket. A bucket with many triangles (dense relief
// in a large mesh) gets a nested grid, as long as that helps. Neighbours share corners, bit by bit, so their common
// side separates them without rounding. For other pairs a penetration below the rounding of positions is ignored.
#include <algorithm>
#include <cstddef>

#include "base/parallel.h"
#include "base/sort.h"
#include "measure/bucket_grid.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

class OverlapFinder {
 public:
  explicit OverlapFinder(const Mesh& mesh) : mesh_(mesh), noise_(position_noise(mesh)) {}

  bool get(std::uint32_t id, PlanTriangle& plan) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh_.triangles[3 * std::size_t{id} + k];
      plan.x[k] = mesh_.positions[3 * v];
      plan.y[k] = mesh_.positions[3 * v + 1];
    }
    const double area = plan.double_area();
    if (area < 0) {
      std::swap(plan.x[1], plan.x[2]);
      std::swap(plan.y[1], plan.y[2]);
    }
    return area != 0;
  }

  /// Makes buckets as large as two ordinary triangles, so that dense clusters do not make buckets small.
  BucketGrid build_grid(const Box& box, std::span<const std::uint32_t> ids) const {
    PlanTriangle plan;
    double covered = 0;
    for (const std::uint32_t id : ids) {
      get(id, plan);
      const Interval across = plan.x_extent(), along = plan.y_extent();
      covered += std::max(0.0, std::min(across.hi, box.x1) - std::max(across.lo, box.x0)) *
                 std::max(0.0, std::min(along.hi, box.y1) - std::max(along.lo, box.y0));
    }
    const double most = static_cast<double>(ids.size()) / 2 + 1;
    const double size = static_cast<double>(ids.size()) * (box.x1 - box.x0) * (box.y1 - box.y0);
    BucketGrid grid(box, static_cast<std::size_t>(covered > 0 ? std::clamp(size / covered, 1.0, most) : most));
    grid.fill([&](const auto& visit) {
      for (const std::uint32_t id : ids) {
        if (get(id, plan)) visit(id, plan);
      }
    });
    return grid;
  }

  /// Appends the overlapping pairs of one bucket to `found`, perhaps repeatedly, until it has `most`.
  void search(const Box& box, std::span<const std::uint32_t> ids, int depth, std::size_t most,
              std::vector<Pair>& found) const {
    if (found.size() >= most) return;
    if (ids.size() > kFew && depth < kDeepest) {
      const BucketGrid grid = build_grid(box, ids);
      std::size_t fullest = 0;
      for (int r = 0; r < grid.rows(); ++r) {
        for (int c = 0; c < grid.cols(); ++c) fullest = std::max(fullest, grid.bucket(c, r).size());
      }
      if (fullest <= ids.size() / 4 * 3) {
        for (int r = 0; r < grid.rows(); ++r) {
          for (int c = 0; c < grid.cols(); ++c)
            search(grid.bucket_box(c, r), grid.bucket(c, r), depth + 1, most, found);
        }
        return;
      }
    }
    compare_all(ids, most, found);
  }

 private:
  static constexpr std::size_t kFew = 32;
  static constexpr int kDeepest = 24;

  void compare_all(std::span<const std::uint32_t> ids, std::size_t most, std::vector<Pair>& found) const {
    struct Entry {
      double x0, x1;
      PlanTriangle plan;
      std::uint32_t id;
    };
    std::vector<Entry> entries(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      get(ids[i], entries[i].plan);
      const Interval across = entries[i].plan.x_extent();
      entries[i].x0 = across.lo;
      entries[i].x1 = across.hi;
      entries[i].id = ids[i];
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.x0 != b.x0 ? a.x0 < b.x0 : a.id < b.id; });
    for (std::size_t i = 0; i < entries.size(); ++i) {
      for (std::size_t j = i + 1; j < entries.size() && entries[j].x0 < entries[i].x1; ++j) {
        if (found.size() >= most) return;
        if (separates(entries[i].plan, entries[j].plan) || separates(entries[j].plan, entries[i].plan)) continue;
        found.emplace_back(std::min(entries[i].id, entries[j].id), std::max(entries[i].id, entries[j].id));
      }
    }
  }

  /// True if `b` is entirely beyond a side of `a`, up to rounding.
  bool separates(const PlanTriangle& a, const PlanTriangle& b) const {
    for (int k = 0; k < 3; ++k) {
      const int next = k == 2 ? 0 : k + 1;
      const double ux = a.x[next] - a.x[k], uy = a.y[next] - a.y[k];
      double deepest = -INFINITY, scale = 0;
      for (int i = 0; i < 3; ++i) {
        const double p = ux * (b.y[i] - a.y[k]), q = uy * (b.x[i] - a.x[k]);
        deepest = std::max(deepest, p - q);
        scale = std::max(scale, std::abs(p) + std::abs(q));
      }
      if (deepest <= 0) return true;
      if (deepest <= noise_ * (std::abs(ux) + std::abs(uy)) + 1e-15 * scale) return true;
    }
    return false;
  }

  const Mesh& mesh_;
  double noise_;
};

}  // namespace

std::uint64_t count_overlaps(const Mesh& mesh, std::span<const std::uint32_t> ids, int threads,
                             FunctionRef<bool(double fraction)> go_on) {
  const OverlapFinder finder(mesh);
  Box box;
  for (const std::uint32_t id : ids) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh.triangles[3 * std::size_t{id} + k];
      box.include(mesh.positions[3 * v], mesh.positions[3 * v + 1]);
    }
  }
  if (ids.size() < 2) return 0;
  const BucketGrid grid = finder.build_grid(box, ids);

  // Rows of buckets are searched in windows; the results of rows are independent.
  const auto rows = static_cast<std::size_t>(grid.rows());
  const std::size_t window = 2 * static_cast<std::size_t>(thread_count(threads));
  std::vector<Pair> pairs;
  for (std::size_t first = 0; first < rows; first += window) {
    if (!go_on(static_cast<double>(first) / static_cast<double>(rows))) return 0;
    std::vector<std::vector<Pair>> found(std::min(window, rows - first));
    parallel_for(found.size(), threads, [&](std::size_t i) {
      const int row = static_cast<int>(first + i);
      for (int c = 0; c < grid.cols(); ++c) {
        finder.search(grid.bucket_box(c, row), grid.bucket(c, row), 0, 4 * kMostOverlaps, found[i]);
      }
      sort_rarely(found[i]);
      found[i].erase(std::unique(found[i].begin(), found[i].end()), found[i].end());
    });
    const std::size_t before = pairs.size();
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    if (pairs.size() == before) continue;
    sort_rarely(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (pairs.size() >= kMostOverlaps) return kMostOverlaps;
  }
  return pairs.size();
}

}  // namespace scarp::judge
