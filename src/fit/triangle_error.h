// How far the samples of one trial triangle lie off its plane: the innermost loop of fitting.
//
// Most trial triangles break the bound, so the scan ends at the first row in which a sample does, and tells which one:
// the sample is likely to break other triangles over the same place. Arithmetic is that of the scan kernels
// (geom/scan_kernels.h) on a lattice of eighths of a sample, summed in eight lanes whatever the machine has; what lies
// within the guard of the threshold is decided exactly.
#pragma once

#include <array>
#include <cstdint>

#include "base/point.h"
#include "geom/predicates.h"
#include "geom/scan_plane.h"
#include "grid/raster.h"

namespace scarp {

/// Steps of the lattice of fitting between two samples.
inline constexpr std::int32_t kLatticeSteps = 8;

/// A corner of a trial triangle.
struct FitCorner {
  std::int32_t x = 0, y = 0;  ///< in lattice steps from the first sample of the window, 0 … kMaxFitSteps
  float z = 0;                ///< at most kMaxScanHeight in magnitude
};

/// Twice the area, positive counter-clockwise.
inline std::int64_t area2(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
}

/// Longest side of a window: crossings of edges with rows are then rational numbers farther apart than the roundings
/// of double (triangle_error.cpp).
inline constexpr std::int32_t kMaxFitSteps = 1 << 22;

/// What may be, and what it costs.
struct ErrorRule {
  double slack = 1;  ///< triangles are let through up to slack × threshold; 1 … 2
  enum class Power { kTwo, kEight };
  Power power = Power::kTwo;  ///< p of the energy Σ (error / threshold)^p
};

struct TriangleTask;

class TriangleError {
 public:
  /// Errors of the raster's samples around `first`, from where corners are counted. REQUIRES: threshold >= 0, finite.
  TriangleError(const Raster& raster, Point first, double threshold, const ErrorRule& rule = {});
  /// The same samples by another rule.
  TriangleError with(const ErrorRule& rule) const { return {raster_, first_, threshold_, rule}; }

  struct Verdict {
    enum class Kind : std::uint8_t {
      kKeeps,   ///< every sample of the closed triangle lies within the limit: without slack, in exact arithmetic
      kBreaks,  ///< one does not: the witness
      kCostly,  ///< the energy reaches the limit, whatever the samples
    };
    Kind kind = Kind::kKeeps;
    float worst = 0;   ///< kKeeps: the largest error as computed, but at most the threshold exactly where every sample
                       ///< keeps the threshold in exact arithmetic
    float energy = 0;  ///< kKeeps: Σ (error / threshold)^p over the samples of the closed triangle; 0 where the
                       ///< threshold is not within 2⁻⁶⁰ … 2⁶⁰
    Point witness;     ///< kBreaks: a sample, counted from the first of the window
  };
  /// REQUIRES: (a, b, c) positive. Cost: O(rows) + samples / 8, less where it breaks; void samples count for nothing.
  Verdict judge(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;

  /// The pull of the samples on the height of corner a, and on its place.
  struct Pull {
    double stiffness = 0;  ///< Σ t⁶ λ², t = error / threshold, λ = weight of a in the triangle at the sample
    double push = 0;       ///< Σ t⁷ λ, positive where the plane is too high
    double slope_x = 0, slope_y = 0;  ///< of the plane, in thresholds a sample
  };
  /// REQUIRES: (a, b, c) positive, has_energy(). Cost: as judge().
  Pull pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const;

  /// What the energy Σ t⁸ becomes when corner a rises by d thresholds: Σ over k of C(8, k)·moments[k]·dᵏ,
  /// moments[k] = Σ t⁸⁻ᵏ λᵏ.
  using Moments = std::array<double, 9>;
  /// Adds a triangle's. REQUIRES, cost: as pull().
  void add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const;

  double threshold() const { return threshold_; }
  double limit() const { return limit_; }  ///< slack × threshold
  bool has_energy() const { return per_threshold_ > 0; }
  /// Of a sample counted from the first of the window.
  float height_at(Point sample) const { return raster_.at({first_.x + sample.x, first_.y + sample.y}); }

 private:
  template <class Add>
  void each_residual(const TriangleTask& task, const std::array<FitCorner, 3>& corners, const Add& add) const;
  template <class Sums>
  Verdict judge_by(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;
  Verdict judge_corners(const std::array<FitCorner, 3>& corners, float energy_limit) const;
  float energy_of(float error) const;
  bool decide(const TriangleTask& task, Verdict& verdict) const;
  void take_side(bool keeps, Verdict& verdict) const;
  bool settle(const TriangleTask& task, Verdict& verdict) const;
  Point find_worst(const TriangleTask& task, std::int32_t y, std::int32_t first, std::int32_t last) const;

  Raster raster_;
  Point first_;
  double threshold_, limit_;
  ErrorRule::Power power_;
  float per_threshold_, per_square_;  // 0 where squares of float32 come to an end
  const float* end_;                  // of the samples
};

}  // namespace scarp
