// How far the samples of one trial triangle lie off its plane: the innermost loop of fitting.
//
// Most trial triangles break the bound, so the scan ends at the first row in which a sample does, and returns that
// sample: the sample is likely to break other triangles over the same place. Arithmetic is that of the scan kernels
// (geom/scan_kernels.h) on a lattice of 256ths of a sample, summed in eight lanes whatever the machine has; what lies
// within the guard of the threshold is decided exactly.
//
// Samples may have bounds of their own instead of the threshold: then errors count in bounds, the threshold is 1, and a
// vertex' pull at a sample is the stronger the smaller its bound. A bound that lies within rounding (0, first of all)
// binds, but has no energy: what is computed there would be noise.
//
// Where channels count too, errors are norms over several fields (norm_error.h), reckoned like those with bounds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/point.h"
#include "fit/fit_norm.h"
#include "geom/predicates.h"
#include "geom/scan_plane.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"

namespace scarp {

/// A corner of a trial triangle.
struct FitCorner {
  std::int32_t x = 0, y = 0;  ///< in lattice steps from the first sample of the window, 0 … kMaxFitSteps
  float z = 0;                ///< at most kMaxScanHeight in magnitude
};

/// An error as computed, moved to the side of the threshold where it belongs.
float on_side_of(double threshold, bool keeps, float error);

/// Twice the area, positive counter-clockwise.
inline std::int64_t area2(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
}

/// Longest side of a window: crossings of edges with rows are then rational numbers farther apart than the roundings
/// of double (triangle_error.cpp).
inline constexpr std::int32_t kMaxFitSteps = 1 << 24;

/// The limits of errors, and their cost.
struct ErrorRule {
  double slack = 1;  ///< triangles are accepted up to slack × threshold; 1 … 4
  enum class Power { kTwo, kEight };
  Power power = Power::kTwo;  ///< p of the energy Σ (error / threshold)^p
};

struct CornerWeight;
struct SampleRows;
struct TriangleKernels;
struct TriangleTask;
class NormError;
class ScatteredErrors;

/// Bounds of samples, row-major like them: at least 0, +infinity for none, no NaN.
struct SampleBounds {
  const float* bounds = nullptr;
  double unit = 1;  ///< above 0: bounds are some 2⁻¹⁵ … 2¹⁵ of it, or vertices will not rise as they should
};

class TriangleError {
 public:
  /// Errors of the raster's samples around `first`, from where corners are counted. REQUIRES: threshold >= 0, finite.
  TriangleError(const Raster& raster, Point first, double threshold, const ErrorRule& rule = {});
  /// The same by bounds; errors are counted in them, so that the threshold is 1. They stay alive.
  TriangleError(const Raster& raster, Point first, const SampleBounds& bounds, const ErrorRule& rule = {});
  /// Norms over several fields, which stay alive. Then corners are samples.
  explicit TriangleError(const NormError& norm, const ErrorRule& rule = {});
  /// Errors at scattered samples, which stay alive. A sample is what they call one.
  explicit TriangleError(const ScatteredErrors& points, const ErrorRule& rule = {});
  /// The same samples by another rule.
  TriangleError with(const ErrorRule& rule) const;

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
                       ///< threshold is not within 2⁻⁶⁰ … 2⁶⁰. With bounds: Σ (error / bound)^p over the samples whose
                       ///< bound is larger than that, and than the rounding of errors in the triangle
    Point witness;  ///< kBreaks: a sample, counted from the first of the window
  };
  /// REQUIRES: (a, b, c) positive. Cost: O(rows) + samples / 8, less where it breaks; nodata samples count for nothing.
  Verdict assess(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;

  /// The pull of the samples on the height of corner a, and on its place. With bounds t = error / bound, and λ is the
  /// weight times unit() / bound: what t changes by where the corner rises by a unit.
  struct Pull {
    double stiffness = 0;  ///< Σ t⁶ λ², t = error / threshold, λ = weight of a in the triangle at the sample
    double push = 0;       ///< Σ t⁷ λ, positive where the plane is too high
    double slope_x = 0, slope_y = 0;  ///< slopes of the plane, in units() a sample
  };
  /// REQUIRES: (a, b, c) positive, has_energy(), no norm. Cost: as assess().
  Pull pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const;

  /// The same for each field; of heights alone one. Fields are reckoned by their scales.
  void pull(const FitCorner& a, const FitCorner& b, const FitCorner& c, std::vector<Pull>& pulls) const;

  /// The coefficients of the energy Σ tᵖ when corner a rises by d units: Σ over k of C(p, k)·moments[k]·dᵏ, moments[k]
  /// = Σ tᵖ⁻ᵏ λᵏ, k <= p.
  using Moments = std::array<double, 9>;
  /// Adds a triangle's. REQUIRES, cost: as pull().
  void add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const;

  /// Rises of corner a, in units, at which samples keep the threshold, as far as rounding knows.
  struct Room {
    float lowest, highest;

    bool is_open() const { return lowest < highest; }
  };
  /// Narrows the room to what the samples of a triangle allow, but for those in which the corner hardly weighs.
  /// REQUIRES, cost: as pull().
  void narrow(const FitCorner& a, const FitCorner& b, const FitCorner& c, Room& room) const;

  double threshold() const { return threshold_; }  ///< Unit of Verdict::worst; 1 with bounds
  double unit() const { return unit_; }            ///< unit of rises: the threshold, or that of the bounds
  bool has_bounds() const { return bounds_.samples != nullptr; }
  ErrorRule::Power power() const { return power_; }
  bool has_energy() const { return per_threshold_ > 0; }
  /// slack × threshold, or the bound, of a sample counted from the first of the window.
  double limit_at(Point sample) const {
    if (norm_ != nullptr) return limit_ * norm_bound_at(sample);
    return has_bounds() ? limit_ * double{bound_at(sample)} : limit_;
  }
  /// Height of a sample counted from the first of the window.
  float height_at(Point sample) const {
    return points_ != nullptr ? place_of(sample).z : raster_.at({first_.x + sample.x, first_.y + sample.y});
  }

  bool has_points() const { return points_ != nullptr; }
  /// The sample next to a place of the window.
  Point sample_near(const FitCorner& place) const {
    constexpr std::int32_t kHalf = kLatticeSteps / 2;
    if (points_ != nullptr) return point_near(place);
    return {(place.x + kHalf) / kLatticeSteps, (place.y + kHalf) / kLatticeSteps};
  }
  /// The place of a sample, and its height; of a raster's sample without it.
  FitCorner place_of(Point sample) const {
    return points_ != nullptr ? point_at(sample) : FitCorner{sample.x * kLatticeSteps, sample.y * kLatticeSteps, 0};
  }
  /// The slopes of scattered samples around a place, in units() a kLatticeSteps.
  std::array<double, 2> point_slope(const FitCorner& place) const;

  /// Fields whose errors count; of heights alone one.
  std::size_t field_count() const;
  /// How their errors are combined.
  Norm norm() const;
  /// Value of a field at a sample, at a corner: times the field's scale, so that errors are limit_at()'s.
  double value_at(std::size_t field, Point sample) const {
    return norm_ == nullptr ? double{height_at(sample)} : norm_value_at(field, sample);
  }
  double value_at(std::size_t field, const FitCorner& corner) const {
    if (norm_ == nullptr) return double{corner.z};
    return norm_value_at(field, {corner.x / kLatticeSteps, corner.y / kLatticeSteps});
  }

 private:
  struct ByThreshold;
  template <class Sums>
  struct ByBounds;
  SampleRows rows() const;
  CornerWeight weight_of(const FitCorner& a, const FitCorner& b, const FitCorner& c) const;
  template <class Sums>
  Sums ask_by_bounds(const TriangleTask& task, const CornerWeight& weight, Sums sums) const;
  TriangleTask task_of(const FitCorner& a, const FitCorner& b, const FitCorner& c) const;
  Verdict assess_by_threshold(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;
  template <class Tally>
  Verdict assess_by_bounds(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;
  Verdict assess_corners(const std::array<FitCorner, 3>& corners, float energy_limit) const;
  float energy_of(float error) const;
  template <class Tally>
  bool decide(const Tally& tally, Verdict& verdict) const;
  template <class Tally>
  bool settle(const Tally& tally, Verdict& verdict) const;
  template <class Tally>
  Point find_worst(const Tally& tally, std::int32_t y, std::int32_t first, std::int32_t last) const;
  FitCorner point_at(Point sample) const;
  Point point_near(const FitCorner& place) const;
  double norm_bound_at(Point sample) const;
  double norm_value_at(std::size_t field, Point sample) const;
  float bound_at(Point sample) const { return bounds_.at({first_.x + sample.x, first_.y + sample.y}); }
  double threshold_at(Point sample) const { return has_bounds() ? double{bound_at(sample)} : threshold_; }
  float in_thresholds(float error, Point sample) const;

  Raster raster_;
  Raster bounds_;  // parallel to the samples
  Point first_;
  double threshold_, limit_, unit_;
  ErrorRule::Power power_;
  float per_threshold_, per_square_;  // 0 where squares of float32 come to an end
  const float* end_;                  // end of the samples
  const TriangleKernels* kernels_;    // kernels of one threshold
  const NormError* norm_ = nullptr;
  const ScatteredErrors* points_ = nullptr;
};

}  // namespace scarp
