// The order in which vertices are removed with repair.
//
// As in removal (removal.h), the cheapest vertex is removed first (removal_queue.h), but with the slack of repair and
// with Σ t⁸, which emphasises errors near the bound. A successful repair makes the prices of all corners of changed
// triangles stale. First, one sweep of flips and steps over the whole patch, within the bound itself, moves vertices
// and edges to places that are good for removal. Without the sweep, a first round would miss vertices that a second one
// removes.
//
// On Fuji and Crater Lake at 2 to 0.5 % of the relief, 2 to 4 % more triangles remain without the sweep, and 2 to 5 %
// more after one round than after two; a third round removes 1 to 2 % more.
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

namespace scarp::fit {

struct RepairOptions {
  RepairDepth depth = {};
  MoveRules rules = {};
  std::uint32_t shake = 0;                    ///< unless 0, vertices are shaken first; seed of the random moves
  int polishes = 0;                           ///< final sweeps over all vertices that lower the squared error
  std::size_t most = 0;                       ///< number of triangles at which removal ends
  std::span<const std::uint8_t> wanted = {};  ///< by node, 1 if it is to be tried first; EMPTY: all nodes
  std::function<bool()> is_time_up = {};      ///< called before each vertex; true ends all but polishing
};

struct RepairCounts {
  std::uint64_t removed = 0;  ///< vertices
  std::uint64_t tried = 0;    ///< removals that were tried
};

/// Removes vertices of the patch. REQUIRES: every triangle of the patch is within the threshold of `error`, which has
/// energies.
RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options);

/// The steps of repair_vertices(), with an energy of either power. Patch, errors and options must outlive this object;
/// nothing else may add or delete nodes meanwhile.
class Schedule {
 public:
  Schedule(Patch& patch, const TriangleError& error, ErrorRule::Power power, const RepairOptions& options);

  /// Computes errors and energies of all triangles by the power. Call it before the other functions.
  void measure_all();
  /// Tries to flip each edge once, then one step of each vertex, within the bound itself. Skips vertices around which
  /// nothing has changed since a step failed.
  void sweep();
  void shake();
  /// Removes vertices, the cheapest first, until at most `most` triangles remain, or no vertex can be removed.
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
  std::vector<std::uint8_t> is_settled_;  // by node, 1 if a step failed and nothing has changed around it since
  RepairCounts counts_;
};

}  // namespace scarp::fit
