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
        vertices_(fitted_.tin.vertex_count()),
        settled_(fitted_.tin.vertex_count(), 0),
        scratch_(static_cast<std::size_t>(thread_count(options.threads))),
        windows_(scratch_.size()) {}

  /// Of removal. `end`: the share of the whole that is then done. False if it was told to stop, as those below.
  bool run(const PatchGrid& grid, double end) {
    return work_on(grid, end, 1, [this](Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
      return remove(patch, vertices, error);
    });
  }

  /// Of removal with repair.
  bool repair(const PatchGrid& grid, double end, Freedom freedom) {
    const std::int32_t steps = freedom == Freedom::kLattice ? kLatticeSteps : 1;
    return work_on(grid, end, steps,
                   [this, freedom](Patch& patch, const std::vector<Vertex>&, const TriangleError& error) {
                     const RepairCounts counts = repair_vertices(patch, error, {options_.repair_depth, freedom});
                     return FitCounts{counts.removed, 0, counts.removed, counts.tried};
                   });
  }

  Fitted finish() { return std::move(fitted_); }

 private:
  /// Cuts, lets job(patch, vertices, error) count what it does to each patch, and joins, to places of so many steps.
  template <class Job>
  bool work_on(const PatchGrid& grid, double end, std::int32_t steps, const Job& job) {
    const PatchCutter cutter(raster_, fitted_.tin, fitted_.places, grid, options_.sides_are_free, options_.threads);
    std::vector<Patch> patches(cutter.count());
    std::vector<std::vector<Vertex>> vertices(cutter.count());
    counts_.assign(cutter.count(), {});
    const auto one = [&](std::size_t i, std::size_t worker) {
      patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
      const TriangleError error = windows_[worker].errors(raster_, patches[i], options_.threshold);
      counts_[i] = job(patches[i], vertices[i], error);
      patches[i].pack();
    };
    bool goes_on = true;
    parallel_in_order(cutter.count(), options_.threads, one, [&](std::size_t i) {
      add(counts_[i]);
      const double share = static_cast<double>(i + 1) / static_cast<double>(cutter.count());
      goes_on = tell(done_ + share * (end - done_));
      return goes_on;
    });
    if (!goes_on) return false;
    done_ = end;
    std::vector<Vertex> numbers;
    VertexPlaces places{steps, {}};
    Triangulation joined = cutter.join(std::move(patches), vertices, numbers, places);
    renumber(numbers, joined.vertex_count());
    fitted_.tin = std::move(joined);
    fitted_.places = std::move(places);
    return true;
  }

  void add(const FitCounts& counts) {
    fitted_.counts.removed += counts.removed;
    fitted_.counts.searches += counts.searches;
    fitted_.counts.repaired += counts.repaired;
    fitted_.counts.tried += counts.tried;
  }
  bool tell(double share) const {
    return !options_.progress || options_.progress(share, vertices_ - fitted_.counts.removed);
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
  std::uint64_t vertices_;                     // of the mesh that was given
  double done_ = 0;                            // share of the whole
  std::vector<std::uint8_t> settled_;          // by vertex
  std::vector<PatchCutter::Scratch> scratch_;  // by thread
  std::vector<SampleWindow> windows_;
  std::vector<FitCounts> counts_;
};

}  // namespace

Result<Fitted> fit(const Raster& raster, Triangulation tin, const FitOptions& options) {
  const std::int32_t side = options.patch_side > 0 ? options.patch_side : patch_side(raster, tin);
  Rounds rounds(raster, std::move(tin), options);
  const bool is_cut = side < std::max(raster.cols, raster.rows);
  const bool has_energies = options.threshold > 0x1p-60 && options.threshold < 0x1p60;
  const bool has_room = std::max(raster.cols, raster.rows) <= kMaxCoordinate / kLatticeSteps;
  const Freedom freedom = options.vertices_are_free && has_room ? Freedom::kLattice : Freedom::kSamples;
  const int repairs = has_energies ? options.repair_rounds : 0;
  // A round of repair takes some five times as long as removal, whose second round looks at little more than what the
  // borders of the first held back.
  const double removal = 1.0 / (1 + 5 * repairs);
  bool goes_on = rounds.run({side, 0}, is_cut ? 0.8 * removal : removal);
  if (goes_on && is_cut) goes_on = rounds.run({side, side / 2}, removal);
  for (int round = 0; goes_on && round < repairs; ++round) {
    const double end = removal + (1 - removal) * (round + 1) / repairs;
    goes_on = rounds.repair({side, is_cut && round % 2 == 1 ? side / 2 : 0}, end, freedom);
  }
  if (!goes_on) return fail(ErrorKind::kCancelled, "cancelled while removing vertices");
  return rounds.finish();
}

}  // namespace scarp
