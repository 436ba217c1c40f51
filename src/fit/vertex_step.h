// A step of one vertex to a better place, its neighbours held fast.
//
// Vertices are samples: the place decides the height. Moving a vertex by (dx, dy) along the terrain changes the
// residual t (error / threshold) at a sample by λ·(s − g)·(dx, dy): λ the weight of the vertex at the sample, g the
// slope of the triangle, s that of the terrain at the vertex. The energy Σ t⁸ is lowest where the Gauss–Newton system
//
//   Σ_f A_f u_f u_fᵀ (dx, dy) = −Σ_f B_f u_f,   u_f = s − g_f,  A_f = Σ t⁶ λ²,  B_f = Σ t⁷ λ over the samples of f
//
// says. The step is tried at three lengths, rounded to samples, and taken where the exact energy of the star falls.
// Vertices on a side of the rectangle slide along it; locked ones stay.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fit/patch.h"
#include "fit/triangle_error.h"

namespace scarp {

class VertexStep {
 public:
  /// The patch stays alive.
  explicit VertexStep(Patch& patch) : patch_(patch) {}

  /// Moves v if a step lowers the energy of its star, every triangle of which the rule of `error` lets through; whether
  /// it did. REQUIRES: v is not removed, energies of its triangles are known. Cost: a scan of the star, and one for
  /// each length that is tried, most of which end early.
  bool improve(const TriangleError& error, Patch::Id v);

 private:
  struct Vector {
    double x = 0, y = 0;
  };
  Vector terrain_slope(const TriangleError& error, const FitCorner& at) const;
  Vector newton_step(const TriangleError& error, Patch::Id v) const;
  double mean_edge(Patch::Id v) const;
  bool try_place(const TriangleError& error, Patch::Id v, const FitCorner& to, float limit);

  Patch& patch_;
  Patch::Star star_;
  std::vector<TriangleError::Verdict> verdicts_;
};

}  // namespace scarp
