// Removal with repair: a vertex is removed although its ring breaks the bound, and its neighbours repair the bound.
//
// The ring is triangulated with up to a slack times the threshold. Then, a few times over, each vertex of the ring
// makes a step (vertex_step.h) and edges around the ring are flipped (flips.h), where triangles are near the bound,
// both led by the energy Σ t⁸ alone, until every triangle that was touched keeps the bound again, in exact arithmetic:
// flips may push a bad triangle out of the stars of the ring, so all of them are asked. A removal that does not come
// right is rolled back. Hopeless cases are left early: those whose excess Σ (worst / threshold − 1) is too large to
// begin with, or after so many rounds. It is a better criterion than the largest error, or than how fast either falls.
//
// The following was measured before kHighDepth got its slack of 3, its rooms and the rule of hopes, with a slack of
// 1.5, 4 rounds and removal without relocation. Triangles against greedy, geometric means of 19 cases in which greedy
// needs less than a quarter of the full grid: removal 0.544, with repair on samples 0.381, with free vertices 0.291; of
// 6 cases beyond 0.641, 0.606, 0.443. The price is 2 to 40 times the time of greedy insertion, the more the fewer
// triangles there are. Going deeper, with vertices free at 1 % on Fuji and Crater Lake: a third round over all vertices
// keeps 0.271 and 0.310 instead of 0.276 and 0.317; besides a slack of 2.5 and 6 rounds of repair 0.249 and 0.277, for
// four times the time; besides the probes of every second round 0.249 and 0.271, for one and a half times that. Steps
// of all vertices of a ring, instead of those at triangles above 0.9 of the bound, save at most 0.5 % of the triangles,
// for a tenth of the time. Choices made here, by triangles on Fuji at 1 %, vertices on samples: powers 4, 6, 8, 12, 16
// of the energy keep 0.358, 0.344, 0.344, 0.340, 0.340; a slack of 1.3, 1.5, 2 0.359, 0.344, 0.335, for some 0.6, 1 and
// 1.5 times the time; 2, 4, 8 rounds 0.349, 0.344, 0.343.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fit/flips.h"
#include "fit/patch.h"
#include "fit/triangle_error.h"
#include "fit/vertex_step.h"

namespace scarp {

/// How far repair goes for one vertex.
struct RepairDepth {
  int rounds = 6;          ///< number of rounds of steps and flips
  double slack = 1.5;      ///< thresholds that triangles of a ring may begin with, 1 … 4
  bool probes = false;     ///< every second round, vertices of the ring probe their surroundings, too
                           ///< (VertexStep::probe)
  bool rooms = false;      ///< heights of free vertices seek the room that the bound allows (height_room.h)
  bool collapses = false;  ///< with free vertices, after each round a pass of collapses (collapse.h)
  double patience = 1;     ///< times the excesses up to which there is hope
  bool mends_all = false;  ///< one round over all of the ring, whether it is near the bound or not
};

class Repair {
 public:
  /// `loose`: with the slack of the depth. Patch and errors stay alive.
  Repair(Patch& patch, const TriangleError& loose, const RepairDepth& depth, const MoveRules& rules)
      : patch_(patch), loose_(loose), depth_(depth), flips_(patch, rules.shape), step_(patch, rules, depth.rooms) {}

  /// Removes v, whose star is given, for these triangles of its ring; false, and nothing has changed, where the bound
  /// cannot be repaired. REQUIRES: every triangle of the patch keeps the bound, energies are known.
  bool remove(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> triangles);

  /// Removes v for a fan about its neighbour u, which moves: two vertices become one. The same else. REQUIRES besides:
  /// u's triangles are then positive and keep the limit.
  bool merge(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> fan, Patch::Id u,
             const FitCorner& place);

  /// A new vertex at the place within the face, or on one of its edges (0 … 2), where its neighbours then make their
  /// steps. REQUIRES: its triangles are positive and keep the threshold; mends_all; the edge is no border.
  Patch::Id insert(const FitCorner& place, Patch::Id face, std::optional<unsigned> edge);

  /// Corners of the triangles that the last of these changed, each once.
  std::span<const Patch::Id> changed() const { return changed_; }

 private:
  struct Excess {
    double sum = 0;  // over the threshold, in thresholds
    bool any = false;
  };
  bool finish();
  bool mend();
  bool is_strained(Patch::Id v, double share);
  void mend_all();
  void look_around(int round);
  Excess excess() const;
  void flip_around(Patch::Id v, double share);
  bool has_changed(const Journal<Patch::Face>::Copy& copy) const;
  void list_changed();

  Patch& patch_;
  const TriangleError& loose_;
  RepairDepth depth_;
  Flips flips_;
  VertexStep step_;
  std::vector<Patch::Id> ring_, moved_, changed_;
  Patch::Star star_;
};

/// Measures a triangle again. REQUIRES: it keeps the limit.
void measure(Patch& patch, const TriangleError& error, Patch::Id face);

}  // namespace scarp
