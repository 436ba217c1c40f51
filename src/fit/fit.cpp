#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "fit/cut.h"
#include "fit/removal.h"
#include "fit/sample_window.h"

namespace scarp {

namespace {

/// Side of squares of some kPatchTriangles; of one that holds all where they are not many more.
std::int32_t patch_side(const Raster& raster, const Triangulation& tin) {
  const auto triangles = static_cast<double>(tin.triangle_count());
  const std::int32_t longest = std::max(raster.cols, raster.rows);
  if (triangles <= 2.0 * kPatchTriangles) return longest;
  const double samples = static_cast<double>(raster.cols) * raster.rows;
  const double side = std::sqrt(samples * kPatchTriangles / triangles);
  return std::clamp(static_cast<std::int32_t>(side), 2, longest);
}

/// One round after the other, on squares that are shifted against each other.
class Rounds {
 public:
  Rounds(const Raster& raster, Triangulation tin, const FitOptions& options)
      : raster_(raster),
        options_(options),
        fitted_{std::move(tin), {}},
        vertices_(fitted_.tin.vertex_count()),
        settled_(fitted_.tin.vertex_count(), 0),
        scratch_(static_cast<std::size_t>(thread_count(options.threads))),
        windows_(scratch_.size()) {}

  /// `begin`, `end`: shares of the whole when the round begins and ends. False if it was told to stop.
  bool run(const PatchGrid& grid, double begin, double end) {
    const PatchCutter cutter(raster_, fitted_.tin, grid, options_.sides_are_free, options_.threads);
    std::vector<Patch> patches(cutter.count());
    std::vector<std::vector<Vertex>> vertices(cutter.count());
    const auto work = [&](std::size_t i, std::size_t worker) {
      patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
      counts_[i] = fit(patches[i], vertices[i], windows_[worker]);
    };
    counts_.assign(cutter.count(), {});
    bool goes_on = true;
    parallel_in_order(cutter.count(), options_.threads, work, [&](std::size_t i) {
      fitted_.counts.removed += counts_[i].removed;
      fitted_.counts.searches += counts_[i].searches;
      const double share = static_cast<double>(i + 1) / static_cast<double>(cutter.count());
      goes_on = tell(begin + share * (end - begin));
      return goes_on;
    });
    if (!goes_on) return false;
    std::vector<Vertex> numbers;
    Triangulation joined = cutter.join(std::move(patches), vertices, numbers);
    renumber(numbers, joined.vertex_count());
    fitted_.tin = std::move(joined);
    return true;
  }

  Fitted finish() { return std::move(fitted_); }

 private:
  bool tell(double share) const {
    return !options_.progress || options_.progress(share, vertices_ - fitted_.counts.removed);
  }

  /// A vertex that is free in one patch is in no other, so patches write to places of their own.
  RemovalCounts fit(Patch& patch, const std::vector<Vertex>& vertices, SampleWindow& window) {
    std::vector<std::uint8_t> settled;
    settled.reserve(vertices.size());
    for (const Vertex v : vertices) settled.push_back(settled_[v]);
    const TriangleError error = window.errors(raster_, patch, options_.threshold);
    const RemovalCounts counts = remove_vertices(patch, error, settled);
    patch.pack();
    for (Patch::Id v = 0; v < vertices.size(); ++v) {
      if (!patch.is_locked(v)) settled_[vertices[v]] = settled[v];
    }
    return counts;
  }

  void renumber(const std::vector<Vertex>& numbers, std::size_t count) {
    std::vector<std::uint8_t> settled(count);
    for (Vertex v = 0; v < numbers.size(); ++v) {
      if (numbers[v] != kNone) settled[numbers[v]] = settled_[v];
    }
    settled_ = std::move(settled);
  }

  const Raster& raster_;
  const FitOptions& options_;
  Fitted fitted_;
  std::uint64_t vertices_;                     // of the mesh that was given
  std::vector<std::uint8_t> settled_;          // by vertex
  std::vector<PatchCutter::Scratch> scratch_;  // by thread
  std::vector<SampleWindow> windows_;
  std::vector<RemovalCounts> counts_;
};

}  // namespace

Result<Fitted> fit(const Raster& raster, Triangulation tin, const FitOptions& options) {
  const std::int32_t side = options.patch_side > 0 ? options.patch_side : patch_side(raster, tin);
  Rounds rounds(raster, std::move(tin), options);
  const bool is_cut = side < std::max(raster.cols, raster.rows);
  // The second round looks at little more than what the borders of the first held back.
  const double share = is_cut ? 0.8 : 1;
  if (!rounds.run({side, 0}, 0, share) || (is_cut && !rounds.run({side, side / 2}, share, 1)))
    return fail(ErrorKind::kCancelled, "cancelled while removing vertices");
  return rounds.finish();
}

}  // namespace scarp
