// Flips by energy: the diagonal of two triangles is flipped if that brings the surface nearer to the samples.
//
// Greedy insertion keeps its edges Delaunay, that is, blind to heights; removal chooses the edges of each ring, but not
// those between rings. A flip that lowers the energy Σ (error / threshold)⁸ turns edges along ridges, and carries an
// error that a ring cannot hold out of it. Within repair flips save up to 3 % of the triangles on samples, 1 % with
// free vertices (Fuji and Crater Lake at 2 to 0.5 % of the relief).
//
// Stars of a ring overlap, so repair asks for the same flip again and again, half of the times with nothing changed in
// between. A flip refused lately is remembered by all that it depends on, and refused at once.
#pragma once

#include <array>
#include <cstddef>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

class Flips {
 public:
  /// For one rule of errors. The patch stays alive.
  Flips(Patch& patch, const ShapeRule& shape) : patch_(patch), shape_(shape) {}

  /// Flips the edge if it is no border, both new triangles are positive, of an allowed shape, and accepted by the rule
  /// of `error`, and the sum of the energies falls. REQUIRES: energies of both triangles are known. Cost: at most two
  /// scans, none where the same was refused lately.
  bool improve(const TriangleError& error, Patch::Id face, unsigned edge);

  /// Flips the edge if the worse of the two triangles has a shape below the floor, and a better one afterwards,
  /// whatever the energies become; whether it did. REQUIRES as improve(). Cost: two scans at most, mostly none.
  bool heal(const TriangleError& error, Patch::Id face, unsigned edge);

 private:
  /// A flip, and the energy that it must stay below. Equal whichever of its two triangles it starts from.
  struct Trial {
    std::array<FitCorner, 4> corners;
    float limit = 0;

    bool operator==(const Trial& other) const;
  };
  static constexpr std::size_t kRefusals = 64;

  bool has_shape(const Patch::Quad& q) const;
  Trial trial_of(const Patch::Quad& q, float limit) const;
  Trial& place_of(const Patch::Quad& q);
  void flip(const Patch::Quad& q, const TriangleError::Verdict& near, const TriangleError::Verdict& far);

  Patch& patch_;
  ShapeRule shape_;
  std::array<Trial, kRefusals> refused_;  // by hash; the last one of each
};

}  // namespace scarp
