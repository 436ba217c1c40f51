// Insertion by squared error: new vertices where the surface gains most.
//
// Candidates are points on each edge within the patch, at 0.3, 0.5 and 0.7 of it, and the centre of each triangle. The
// fan of triangles about a candidate has the energy E(d) = Σ (t + λ d)² when its height rises by d; the minimum is
// exact (height_step.h). The gain is the energy of the replaced triangles less that minimum. The candidate with the
// largest gain is inserted first; then its neighbours make their steps (repair.h). The gain is a poor estimate of a
// vertex's final worth, which comes mostly from these steps, but it ranks the places (bench/quality/squares.csv).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fit/patch.h"
#include "fit/repair.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

class Insertion {
 public:
  /// `error`: sums squares. `repair`: uses an error with the same threshold. REQUIRES: all outlive this object.
  Insertion(Patch& patch, const TriangleError& error, const MoveRules& rules, Repair& repair)
      : patch_(patch), error_(error), rules_(rules), repair_(repair) {}

  /// Inserts until there are `most` triangles, or no candidate gains. REQUIRES: energies by `error` are known; no
  /// triangle is beyond the threshold.
  void run(std::size_t most);

 private:
  struct Offer {
    float gain = 0;
    Patch::Id face = 0, beyond = 0;  // equal if the place is within the face
    std::optional<unsigned> edge = std::nullopt;
    FitCorner place = {};
    std::uint32_t stamp = 0, stamp_beyond = 0;
  };
  static bool is_later(const Offer& a, const Offer& b) { return a.gain != b.gain ? a.gain < b.gain : a.face > b.face; }

  void offer(Patch::Id face);
  Offer best_at(Patch::Id face);
  void try_place(double x, double y, Offer& best, const Offer& kind);
  bool is_fresh(const Offer& offer) const;
  void take(const Offer& offer);

  Patch& patch_;
  const TriangleError& error_;
  MoveRules rules_;
  Repair& repair_;
  std::vector<Offer> heap_;
  std::vector<std::uint32_t> stamps_;  // by face: number of its changes
  std::vector<FitCorner> rim_;         // rim of the triangles that a candidate would replace
  float energy_ = 0;                   // energy of these triangles
  TriangleShape floor_;                // floor of the new shapes
  Patch::Star star_;
};

}  // namespace scarp::fit
