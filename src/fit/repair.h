// Removal with repair: a vertex is removed although its ring breaks the bound, and its neighbours repair the bound.
//
// The ring is triangulated with errors up to slack times the threshold. A few rounds follow. In each round, vertices of
// the ring with triangles beyond the bound make a step (vertex_step.h), and edges of triangles near the bound are
// flipped (flips.h), both to lower the energy Σ t⁸. The rounds end when all changed triangles are within the bound
// again, in exact arithmetic. All of them are checked, since flips may move a bad triangle out of the stars of the
// ring. A removal that cannot be repaired is rolled back. Hopeless cases end early: those whose excess Σ (worst /
// threshold − 1) is above a limit for the number of rounds so far. The excess is a better criterion than the largest
// error, or the decrease of either.
//
// The limits are learned. On smooth fields, three times as many repairs succeed from the same excess as on terrain.
// After each repair, the limits of the rounds in which its excess was near the limit rise (success) or fall (failure),
// in a ratio that keeps the share of successes near the limit at `worth`, or the limit at its least value. With fixed
// limits, high effort leaves 1.09 times the triangles in 0.85 times the time on the fields of
// bench/quality/optimum.cpp, and 1.005 times the triangles in 0.97 times the time in 25 cases of terrain.
//
// The following was measured with a slack of 1.5, 4 rounds and removal without relocation, before kHighDepth got a
// slack of 3, rooms and the limits of the excess. Triangles relative to greedy insertion, as geometric means of 19
// cases in which greedy needs less than a quarter of the full grid: 0.544 with removal, 0.381 with repair on samples,
// 0.291 with repair and free vertices; for 6 other cases 0.641, 0.606, 0.443. The time is 2 to 40 times that of greedy
// insertion; the factor is largest for small meshes. Deeper repair with free vertices at 1 % on Fuji and Crater Lake: a
// third round over all vertices leaves 0.271 and 0.310 instead of 0.276 and 0.317. With a slack of 2.5 and 6 rounds of
// repair in addition, 0.249 and 0.277 remain, in four times the time; with probes in every second round too, 0.249 and
// 0.271 remain, in one and a half times that time. Steps of all vertices of a ring, instead of those at triangles above
// 0.9 of the bound, save at most 0.5 % of the triangles, for a tenth more time. Triangles on Fuji at 1 %, with vertices
// on samples: for powers 4, 6, 8, 12, 16 of the energy 0.358, 0.344, 0.344, 0.340, 0.340; for a slack of 1.3, 1.5, 2
// 0.359, 0.344, 0.335, in some 0.6, 1 and 1.5 times the time; for 2, 4, 8 rounds 0.349, 0.344, 0.343.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fit/flips.h"
#include "fit/patch.h"
#include "fit/triangle_error.h"
#include "fit/vertex_step.h"

namespace scarp::fit {

/// The limits of repair for one vertex.
struct RepairDepth {
  int rounds = 10;         ///< number of rounds of steps and flips
  double slack = 1.5;      ///< initial error limit of a ring's triangles, in thresholds, 1 … 4
  bool probes = false;     ///< in every second round, vertices of the ring also try places around them
                           ///< (VertexStep::probe)
  bool rooms = false;      ///< heights of free vertices seek room within the bound (height_room.h)
  bool collapses = false;  ///< with free vertices, a pass of collapses after each round (collapse.h)
  double patience = 1;     ///< factor of the initial limits of the excess
  double worth = 0.07;     ///< share of successes near the limits
  bool mends_all = false;  ///< one round over the whole ring, including triangles far from the bound
};

class Repair {
 public:
  /// `loose`: errors with the slack of the depth. Patch and errors must outlive this object.
  Repair(Patch& patch, const TriangleError& loose, const RepairDepth& depth, const MoveRules& rules)
      : patch_(patch),
        loose_(loose),
        depth_(depth),
        flips_(patch, rules.shape),
        step_(patch, rules, depth.rooms),
        limits_(first_limits(depth)) {}

  /// Removes v and replaces its star by these triangles of its ring. False, with nothing changed, if the bound cannot
  /// be repaired. REQUIRES: every triangle of the patch is within the bound; energies are known.
  bool remove(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> triangles);

  /// Like remove(), with a fan about v's neighbour u, which moves to `place`: two vertices become one. REQUIRES also:
  /// u's triangles are then positive and within the limit.
  bool merge(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> fan, Patch::Id u,
             const FitCorner& place);

  /// Inserts a vertex at the place within the face, or on one of its edges (0 … 2). Then its neighbours make their
  /// steps. REQUIRES: its triangles are positive and within the threshold; mends_all; the edge is no border.
  Patch::Id insert(const FitCorner& place, Patch::Id face, std::optional<unsigned> edge);

  /// Corners of the triangles that the last of these calls changed, each once.
  std::span<const Patch::Id> changed() const { return changed_; }

 private:
  struct Excess {
    double sum = 0;  // excess over the threshold, in thresholds
    bool any = false;
  };
  bool finish();
  static std::vector<double> first_limits(const RepairDepth& depth);
  bool mend();
  bool mend_by_rounds();
  void learn(bool is_repaired);
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
  std::vector<double> limits_;    // limits of the excess, by the number of rounds so far
  std::vector<double> excesses_;  // excesses of the last repair, before each of its rounds
  std::vector<Patch::Id> ring_, moved_, changed_;
  Patch::Star star_;
};

/// Measures a triangle again. REQUIRES: it is within the limit.
void measure(Patch& patch, const TriangleError& error, Patch::Id face);

}  // namespace scarp::fit
