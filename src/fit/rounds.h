// Successive rounds of fitting, in squares shifted against each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "fit/cut.h"
#include "fit/fit.h"
#include "fit/schedule.h"

namespace scarp::fit {

class Rounds {
 public:
  /// Raster and options must outlive this object.
  Rounds(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice, const FitOptions& options);

  /// Raises the threshold towards one for which the mesh is within the options' budgets, after `left` of its triangles
  /// remain in the rounds that follow anyway. Returns false if the mesh is within them or the threshold is the largest.
  bool raise_threshold(double left = 1);
  /// True if the mesh is so large that the round after the last rise is likely to be the last one.
  bool is_last_rise() const { return is_last_rise_; }

  /// A round of removal. `relocates`: each vertex then makes a step, and removal continues. `end`: finished share of
  /// the whole work after the round. This and the other rounds return false if cancelled.
  bool run(const PatchGrid& grid, double end, bool relocates = false);

  /// A round of removal with repair. `only_held`: begins with the vertices near those that were on borders of repair so
  /// far.
  bool repair(const PatchGrid& grid, double end, const RepairOptions& options, bool only_held = false);

  /// The options of a round of repair. `shake`: see RepairOptions.
  RepairOptions repair_options(int polishes, std::uint32_t shake) const {
    return {options_.depth.repair, rules_, shake, polishes, 0, {}, options_.is_time_up};
  }

  /// For squared errors: prepares each patch, passes all of them to `between`, then calls `job` for each.
  using Prepare = FunctionRef<void(Patch& patch, const TriangleError& error)>;
  using Between = FunctionRef<void(std::span<const Patch> patches)>;
  using Job = FunctionRef<void(std::size_t i, Patch& patch, const TriangleError& error)>;
  bool work_twice(const PatchGrid& grid, double end, Prepare prepare, Between between, Job job);

  /// Forgets borders of removal, which handles their vertices itself.
  void forget_held() { held_.assign(held_.size(), 0); }

  const tin::Triangulation& tin() const { return fitted_.tin; }
  /// The rules of moves other than removal, without the floor if the floor yields.
  MoveRules rules_of(const Patch& patch) const;

  bool is_time_up() const { return options_.is_time_up && options_.is_time_up(); }
  std::uint64_t vertices() const { return vertices_ - fitted_.counts.removed; }
  std::uint64_t triangles() const;  ///< without those outside

  Fitted finish();

 private:
  using Work =
      FunctionRef<FitCounts(Patch& patch, const std::vector<tin::Vertex>& vertices, const TriangleError& error)>;
  bool work_on(const PatchGrid& grid, double end, std::int32_t steps, Work work);
  bool is_worked_on(const Patch& patch) const;
  TriangleError errors_of(const Patch& patch, SampleWindow& window) const;
  PatchCutter cutter(const PatchGrid& grid) const;
  /// The share of the triangles that suffices for the budgets.
  double wanted_share() const;
  /// Number of triangles of the patch at which removal ends.
  std::size_t most_of(const Patch& patch) const;
  std::int32_t steps_of(Freedom freedom) const;
  Freedom relocation_freedom() const;
  bool each_patch(std::size_t count, double begin, double end,
                  FunctionRef<void(std::size_t i, std::size_t worker)> one);
  void join(const PatchCutter& cutter, std::vector<Patch> patches, std::vector<std::vector<tin::Vertex>> vertices,
            std::int32_t steps);
  void add(const FitCounts& counts);
  bool tell(double share) const { return !options_.progress || options_.progress(share, vertices()); }
  FitCounts remove(Patch& patch, const std::vector<tin::Vertex>& vertices, const TriangleError& error, bool relocates);
  void hold_borders(const std::vector<std::vector<tin::Vertex>>& vertices);
  std::vector<std::uint8_t> near_held(const Patch& patch, const std::vector<tin::Vertex>& vertices) const;
  void renumber(const std::vector<tin::Vertex>& numbers, std::size_t count);

  const grid::Raster& raster_;
  const FitOptions& options_;
  MoveRules rules_;
  Fitted fitted_;
  std::uint64_t vertices_;        // vertices of the input mesh
  double power_ = 1.4;            // triangles ~ threshold^-power
  double step_ = 0;               // logarithm of the last rise of the threshold
  std::optional<double> excess_;  // logarithm of the triangles before it, relative to the budgets
  double kept_ = 0;               // share of a patch's triangles at which removal ends
  bool is_last_rise_ = false;
  bool is_whole_ = false;                      // the last round had one patch
  double done_ = 0;                            // finished share of the work
  std::vector<std::uint8_t> settled_;          // by vertex
  std::vector<std::uint8_t> held_;             // by vertex: it has been on a border between patches
  std::vector<PatchCutter::Scratch> scratch_;  // by thread
  std::vector<SampleWindow> windows_;
  std::vector<FitCounts> counts_;
};

}  // namespace scarp::fit
