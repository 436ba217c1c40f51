// Collapse: one new vertex replaces two neighbours.
//
// Removal with repair removes one vertex, and its neighbours repair the bound. Where no vertex can go that way, a
// better placed third vertex can often replace two. For each edge u–v within the patch the polygon around both stars
// becomes a fan about a new vertex w. Its place is searched for: the better one of three on the edge, then steps along
// both axes, 0.3, 0.15 and 0.07 of the edge long, while the energy Σ t⁸ of the fan falls; at each place w has its best
// height (height_step.h), or the nearest with room (height_room.h). Fans that promise too little are left early. The
// rest are tried, the least rise of energy first, with the slack of repair and mended as it mends (repair.h); what it
// has changed waits for the next pass.
//
// One pass after each round of max keeps 0.970 of the triangles (0.895 to 1.009 in the 42 cases of
// bench/quality/efforts.csv), for some 1.4 to 1.7 times the time, with an RMSE 1.024 times as large. For as much time,
// more rounds without collapses keep more: collapses reach 0.977 to 0.986 of theirs (Fuji at 5, 1 and 0.2 % of the
// relief, Crater Lake at 1 and 0.5 %). Further passes in a round find less than 1 % more for as much time again, with
// half the places tried 0.5 % more triangles remain for a twentieth of the time.
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

namespace scarp {

class Collapse {
 public:
  /// `loose`: with the slack of the repair. All stay alive.
  Collapse(Patch& patch, const TriangleError& loose, const MoveRules& rules, Repair& repair)
      : patch_(patch), loose_(loose), rules_(rules), repair_(repair) {}

  struct Counts {
    std::uint64_t done = 0, tried = 0;
  };
  /// One pass over the edges between vertices of which `is_wanted` holds for one at least; neither may be locked nor
  /// lie on a side. REQUIRES: vertices are free; every triangle of the patch keeps the threshold, energies are known.
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
  std::vector<Patch::Id> polygon_;  // around the edge
  std::size_t hub_ = 0;             // position of u on the ring of v
  float energy_ = 0;                // energy of the triangles that the fan would replace
  TriangleShape floor_;             // floor of its shapes
  std::vector<Offer> offers_;
  std::vector<Patch::RingTriangle> fan_;
};

}  // namespace scarp
