// Flips by energy: the diagonal of two triangles is changed where that brings the surface nearer to the samples.
//
// Greedy insertion keeps its edges Delaunay, that is, blind to heights; removal chooses the edges of each ring, but not
// those between rings. A flip that lowers the energy Σ (error / threshold)⁸ lets edges run along ridges, and is what
// carries an error that a ring cannot hold out of it.
#pragma once

#include "fit/patch.h"
#include "fit/triangle_error.h"

namespace scarp {

class Flips {
 public:
  /// The patch stays alive.
  explicit Flips(Patch& patch) : patch_(patch) {}

  /// Flips the edge if it is no border, both new triangles are positive and let through by the rule of `error`, and the
  /// sum of the energies falls. REQUIRES: energies of both triangles are known. Cost: at most two scans.
  bool improve(const TriangleError& error, Patch::Id face, unsigned edge);

 private:
  Patch& patch_;
};

}  // namespace scarp
