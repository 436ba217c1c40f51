#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "fit/cut.h"
#include "fit/removal.h"
#include "fit/sample_window.h"
#include "fit/schedule.h"

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
        fitted_{std::move(tin), {}, {}},
        settled_(fitted_.tin.vertex_count(), 0),
        scratch_(static_cast<std::size_t>(thread_count(options.threads))),
        windows_(scratch_.size()) {}

  /// Of removal.
  void run(const PatchGrid& grid) {
    work_on(grid, 1, [this](Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
      return remove(patch, vertices, error);
    });
  }

  /// Of removal with repair.
  void repair(const PatchGrid& grid, Freedom freedom) {
    const std::int32_t steps = freedom == Freedom::kLattice ? kLatticeSteps : 1;
    work_on(grid, steps, [this, freedom](Patch& patch, const std::vector<Vertex>&, const TriangleError& error) {
      const RepairCounts counts = repair_vertices(patch, error, {options_.repair_depth, freedom});
      return FitCounts{counts.removed, 0, counts.removed, counts.tried};
    });
  }

  Fitted finish() { return std::move(fitted_); }

 private:
  /// Cuts, lets work(patch, vertices, error) count what it does to each patch, and joins, to places of so many steps.
  template <class Work>
  void work_on(const PatchGrid& grid, std::int32_t steps, const Work& work) {
    const PatchCutter cutter(raster_, fitted_.tin, fitted_.places, grid, options_.sides_are_free, options_.threads);
    std::vector<Patch> patches(cutter.count());
    std::vector<std::vector<Vertex>> vertices(cutter.count());
    counts_.assign(cutter.count(), {});
    const auto one = [&](std::size_t i, std::size_t worker) {
      patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
      const TriangleError error = windows_[worker].errors(raster_, patches[i], options_.threshold);
      counts_[i] = work(patches[i], vertices[i], error);
      patches[i].pack();
    };
    parallel_in_order(cutter.count(), options_.threads, one, [](std::size_t) { return true; });
    for (const FitCounts& counts : counts_) {
      fitted_.counts.removed += counts.removed;
      fitted_.counts.searches += counts.searches;
      fitted_.counts.repaired += counts.repaired;
      fitted_.counts.tried += counts.tried;
    }
    std::vector<Vertex> numbers;
    VertexPlaces places{steps, {}};
    Triangulation joined = cutter.join(std::move(patches), vertices, numbers, places);
    renumber(numbers, joined.vertex_count());
    fitted_.tin = std::move(joined);
    fitted_.places = std::move(places);
  }

  /// A vertex that is free in one patch is in no other, so patches write to places of their own.
  FitCounts remove(Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
    std::vector<std::uint8_t> settled;
    settled.reserve(vertices.size());
    for (const Vertex v : vertices) settled.push_back(settled_[v]);
    const RemovalCounts counts = remove_vertices(patch, error, settled);
    for (Patch::Id v = 0; v < vertices.size(); ++v) {
      if (!patch.is_locked(v)) settled_[vertices[v]] = settled[v];
    }
    return {counts.removed, counts.searches, 0, 0};
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
  std::vector<std::uint8_t> settled_;          // by vertex
  std::vector<PatchCutter::Scratch> scratch_;  // by thread
  std::vector<SampleWindow> windows_;
  std::vector<FitCounts> counts_;
};

}  // namespace

Fitted fit(const Raster& raster, Triangulation tin, const FitOptions& options) {
  const std::int32_t side = options.patch_side > 0 ? options.patch_side : patch_side(raster, tin);
  Rounds rounds(raster, std::move(tin), options);
  rounds.run({side, 0});
  const bool is_cut = side < std::max(raster.cols, raster.rows);
  if (is_cut) rounds.run({side, side / 2});
  const bool has_energies = options.threshold > 0x1p-60 && options.threshold < 0x1p60;
  const bool has_room = std::max(raster.cols, raster.rows) <= kMaxCoordinate / kLatticeSteps;
  const Freedom freedom = options.vertices_are_free && has_room ? Freedom::kLattice : Freedom::kSamples;
  for (int round = 0; has_energies && round < options.repair_rounds; ++round)
    rounds.repair({side, is_cut && round % 2 == 1 ? side / 2 : 0}, freedom);
  return rounds.finish();
}

}  // namespace scarp
