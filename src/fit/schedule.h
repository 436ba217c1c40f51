// The vertices that are removed with repair, and their order.
//
// Like in removal (removal.h) the cheapest goes first (removal_queue.h), but with the slack of repair and with Σ t⁸,
// which weighs what is near the bound. A successful repair makes the prices of all corners of changed triangles stale.
// Before, one sweep of flips and steps over the whole patch, under the bound itself, puts vertices and edges where
// removal wants them: without it a second round would find what the first left.
//
// On Fuji and Crater Lake at 2 to 0.5 % of the relief 2 to 4 % more triangles stay without the sweep, 2 to 5 % more
// after one round than after two; a third removes 1 to 2 % more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fit/patch.h"
#include "fit/repair.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

struct RepairOptions {
  RepairDepth depth = {};
  MoveRules rules = {};
  std::uint32_t shake = 0;  ///< other than 0: vertices are shaken first, by dice that this is the seed of
  int polishes = 0;         ///< sweeps that lower the squared error at the end, over all vertices
  std::span<const std::uint8_t> wanted = {};  ///< by node, 1 for those to try first; EMPTY: all
  std::function<bool()> is_time_up = {};      ///< asked before each vertex; true ends the rest but for polishing
};

struct RepairCounts {
  std::uint64_t removed = 0;  ///< vertices
  std::uint64_t tried = 0;    ///< removals that were begun
};

/// Removes vertices of the patch.
/// REQUIRES: every triangle of the patch keeps the threshold of `error`, which has energies.
RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options);

/// The steps of it, by an energy of either power. Patch, errors and options stay alive; nodes are neither added nor
/// deleted by others meanwhile.
class Schedule {
 public:
  Schedule(Patch& patch, const TriangleError& error, ErrorRule::Power power, const RepairOptions& options);

  /// Errors and energies of all triangles by the power. REQUIRED before the others.
  void measure_all();
  /// Tries each edge once, and one step of each vertex around which anything has changed since its last step found
  /// nothing, under the bound itself.
  void sweep();
  void shake();
  /// The cheapest vertex first, until no more than `most` triangles are left, or none can go.
  void remove_all(std::size_t most = 0);
  /// REQUIRES: vertices are free.
  void collapse();

  const RepairCounts& counts() const { return counts_; }

 private:
  struct Removals;

  bool is_wanted(Patch::Id v) const { return options_.wanted.empty() || options_.wanted[v] != 0; }
  bool is_time_up() const { return options_.is_time_up && options_.is_time_up(); }
  void unsettle_flipped(Patch::Id face);

  Patch& patch_;
  TriangleError strict_, loose_;
  const RepairOptions& options_;
  Repair repair_;
  Patch::Star star_;
  std::vector<std::uint8_t> is_settled_;  // by node, 1 where a step found nothing and nothing has changed around since
  RepairCounts counts_;
};

/// Triangles of the patch.
std::size_t count_faces(const Patch& patch);

}  // namespace scarp
