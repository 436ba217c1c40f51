// Collapse: one new vertex replaces two neighbours.
//
// Removal with repair removes one vertex, and its neighbours repair the bound. Where no vertex can be removed that way,
// one better placed vertex can often replace two. For each edge u–v within the patch, a fan about a new vertex w fills
// the polygon around both stars. The search for w's place begins at the best of three points on the edge. Steps of 0.3,
// 0.15 and 0.07 of the edge's length along both axes follow while the energy Σ t⁸ of the fan falls. At each place, w
// has the height of least energy (height_step.h), or the nearest height with room (height_room.h). Fans with too much
// energy are dropped early. The others are tried in the order of their rise of energy, with repair (repair.h). Edges at
// changed triangles wait for the next pass.
//
// With one pass after each round of effort max, 0.970 of the triangles remain (0.895 to 1.009 in the 42 cases of
// bench/quality/efforts.csv). This needs some 1.4 to 1.7 times the time, and the RMSE is 1.024 times as large. In the
// same time, more rounds without collapses end with more triangles: collapses reach 0.977 to 0.986 of their number
// (Fuji at 5, 1 and 0.2 % of the relief, Crater Lake at 1 and 0.5 %). A further pass needs as much time and removes
// less than 1 % more. Trying half the places saves a twentieth of the time and leaves 0.5 % more triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/function_ref.h"
#include "fit/patch.h"
#include "fit/repair.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

class Collapse {
 public:
  /// `loose`: errors with the slack of the repair. All arguments must outlive this object.
  Collapse(Patch& patch, const TriangleError& loose, const MoveRules& rules, Repair& repair)
      : patch_(patch), loose_(loose), rules_(rules), repair_(repair) {}

  struct Counts {
    std::uint64_t done = 0, tried = 0;
  };
  /// One pass over the edges with an end for which `is_wanted` is true and no end that is locked or on a side.
  /// REQUIRES: vertices are free; every triangle of the patch is within the threshold; energies are known.
  Counts run(FunctionRef<bool(Patch::Id)> is_wanted, const std::function<bool()>& is_time_up);

 private:
  struct Offer {
    float rise = 0;  // rise of the energy; edges that are too short come first
    Patch::Id v = 0, u = 0;
    FitCorner place;
  };
  bool find_polygon(Patch::Id v, Patch::Id u);
  const FitCorner& corner(std::size_t i) const { return patch_.at(polygon_[i % polygon_.size()]); }
  bool search(Patch::Id v, Patch::Id u, Offer& offer) const;
  void offer_edges_of(Patch::Id v, FunctionRef<bool(Patch::Id)> is_wanted);
  bool take(const Offer& offer);
  void add_fan(std::size_t first, std::size_t last);

  Patch& patch_;
  const TriangleError& loose_;
  MoveRules rules_;
  Repair& repair_;
  Patch::Star star_, other_, around_;
  std::vector<Patch::Id> polygon_;
  std::size_t hub_ = 0;  // position of u on the ring of v
  float energy_ = 0;     // energy of the triangles that the fan would replace
  TriangleShape floor_;  // floor of its shapes
  std::vector<Offer> offers_;
  std::vector<Patch::RingTriangle> fan_;
};

}  // namespace scarp::fit
