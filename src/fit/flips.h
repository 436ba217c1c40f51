// Flips by energy: flips the diagonal of two triangles if that brings the surface nearer to the samples.
//
// Greedy insertion uses Delaunay edges, which ignore heights. Removal chooses the edges of each ring, but not those
// between rings. A flip that lowers the energy Σ (error / threshold)⁸ turns edges along ridges, and moves a large error
// out of a ring. Within repair, flips save up to 3 % of the triangles with vertices on samples, and 1 % with free
// vertices (Fuji and Crater Lake at 2 to 0.5 % of the relief).
//
// Stars of a ring overlap, so repair tries the same flip repeatedly, half of the time with unchanged triangles. A
// recently refused flip is stored with its inputs, and refused again without a scan.
#pragma once

#include <array>
#include <cstddef>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

class Flips {
 public:
  /// For one rule of errors. The patch must outlive this object.
  Flips(Patch& patch, const ShapeRule& shape) : patch_(patch), shape_(shape) {}

  /// Flips the edge if it is no border, both new triangles are positive, have an allowed shape and satisfy the rule of
  /// `error`, and the sum of the energies falls. REQUIRES: energies of both triangles are known. Cost: at most two
  /// scans; none if the same flip was refused recently.
  bool improve(const TriangleError& error, Patch::Id face, unsigned edge);

  /// Flips the edge if a triangle's shape is below the floor and the worse of the two shapes improves, whatever the
  /// energies become. True if it flipped. REQUIRES: as improve(). Cost: at most two scans, usually none.
  bool heal(const TriangleError& error, Patch::Id face, unsigned edge);

 private:
  /// A flip and its energy limit; the same from either of its two triangles.
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
  std::array<Trial, kRefusals> refused_;  // by hash, the last trial of each
};

}  // namespace scarp::fit
