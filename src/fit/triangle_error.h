// Errors of the samples of one trial triangle: the innermost loop of fitting.
//
// Most trial triangles break the bound, so the scan ends at the first row with a sample beyond the bound, and returns
// that sample, which is likely to exclude other triangles over the same place. The arithmetic is that of the scan
// kernels (geom/scan_kernels.h) on a lattice with steps of 1/256 of a sample, summed in eight lanes on every machine.
// Errors within the guard of the threshold are decided exactly.
//
// Samples may have their own bounds instead of the threshold. Then errors are divided by their bounds, the threshold is
// 1, and a sample with a smaller bound pulls a vertex more strongly. A bound within rounding, such as 0, must be
// satisfied but has no energy, since that would be noise.
//
// If channels count too, errors are norms over several fields (norm_error.h), computed like those with bounds.
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

namespace scarp::fit {

struct FitCorner {
  std::int32_t x = 0, y = 0;  ///< in lattice steps from the first sample of the window, 0 … kMaxFitSteps
  float z = 0;                ///< at most kMaxScanHeight in magnitude
};

/// The computed error, moved to the exact side of the threshold.
float on_side_of(double threshold, bool keeps, float error);

/// Twice the area, positive counter-clockwise.
inline std::int64_t area2(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
}

/// Longest side of a window. Up to this length, crossings of edges with rows are rational numbers that are farther
/// apart than the rounding of doubles (triangle_error.cpp).
inline constexpr std::int32_t kMaxFitSteps = 1 << 24;

/// The limits of errors, and their energy.
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
  double unit = 1;  ///< above 0; heights are good if bounds are some 2⁻¹⁵ … 2¹⁵ of this unit
};

class TriangleError {
 public:
  /// Errors of the raster's samples. `first`: origin from which corners are counted. REQUIRES: threshold >= 0, finite.
  TriangleError(const grid::Raster& raster, Point first, double threshold, const ErrorRule& rule = {});
  /// The same with bounds, which must outlive this object. Errors are divided by their bounds, so the threshold is 1.
  TriangleError(const grid::Raster& raster, Point first, const SampleBounds& bounds, const ErrorRule& rule = {});
  /// Norms over several fields, which must outlive this object. Corners are samples.
  explicit TriangleError(const NormError& norm, const ErrorRule& rule = {});
  /// Errors at scattered samples, which must outlive this object and define the meaning of a sample's `Point`.
  explicit TriangleError(const ScatteredErrors& points, const ErrorRule& rule = {});
  /// The same samples by another rule.
  TriangleError with(const ErrorRule& rule) const;

  struct Verdict {
    enum class Kind : std::uint8_t {
      kKeeps,   ///< every sample of the closed triangle is within the limit; exactly, if slack is 1
      kBreaks,  ///< a sample is beyond the limit: the witness
      kCostly,  ///< the energy reaches its limit
    };
    Kind kind = Kind::kKeeps;
    float worst = 0;   ///< kKeeps: the largest computed error, adjusted to be at most the threshold if and only if
                       ///< every sample is within the threshold in exact arithmetic
    float energy = 0;  ///< kKeeps: Σ (error / threshold)^p over the samples of the closed triangle; 0 if the threshold
                       ///< is not within 2⁻⁶⁰ … 2⁶⁰. With bounds: Σ (error / bound)^p over the samples with bounds
                       ///< above 2⁻⁶⁰ and above the rounding of errors in the triangle
    Point witness;  ///< kBreaks: a sample, counted from the first of the window
  };
  /// Ignores nodata. REQUIRES: (a, b, c) positive. Cost: O(rows) + samples / 8, less if a sample breaks the limit.
  Verdict assess(const FitCorner& a, const FitCorner& b, const FitCorner& c, float energy_limit) const;

  /// The pull of the samples on the height and the place of corner a. With bounds, t = error / bound, and λ is the
  /// weight times unit() / bound: the change of t when the corner rises by a unit.
  struct Pull {
    double stiffness = 0;  ///< Σ t⁶ λ², t = error / threshold, λ = weight of a in the triangle at the sample
    double push = 0;       ///< Σ t⁷ λ, positive where the plane is too high
    double slope_x = 0, slope_y = 0;  ///< slopes of the plane, in unit() per sample
  };
  /// REQUIRES: (a, b, c) positive, has_energy(), no norm. Cost: as for assess().
  Pull pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const;

  /// The same for each field, scaled; one pull for heights only.
  void pull(const FitCorner& a, const FitCorner& b, const FitCorner& c, std::vector<Pull>& pulls) const;

  /// The coefficients of the energy Σ tᵖ when corner a rises by d units: Σ over k of C(p, k)·moments[k]·dᵏ, moments[k]
  /// = Σ tᵖ⁻ᵏ λᵏ, k <= p.
  using Moments = std::array<double, 9>;
  /// Adds the moments of a triangle. REQUIRES, cost: as for pull().
  void add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const;

  /// Rises of corner a, in units, at which samples are within the threshold, up to rounding.
  struct Room {
    float lowest, highest;

    bool is_open() const { return lowest < highest; }
  };
  /// Narrows the room to the rises that a triangle's samples allow; ignores samples at which the corner has almost no
  /// weight. REQUIRES, cost: as for pull().
  void narrow(const FitCorner& a, const FitCorner& b, const FitCorner& c, Room& room) const;

  double threshold() const { return threshold_; }  ///< unit of Verdict::worst; 1 with bounds
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
  /// The sample nearest to a place of the window.
  Point sample_near(const FitCorner& place) const {
    constexpr std::int32_t kHalf = grid::kLatticeSteps / 2;
    if (points_ != nullptr) return point_near(place);
    return {(place.x + kHalf) / grid::kLatticeSteps, (place.y + kHalf) / grid::kLatticeSteps};
  }
  /// The place of a sample, with the height of a scattered one.
  FitCorner place_of(Point sample) const {
    return points_ != nullptr ? point_at(sample)
                              : FitCorner{sample.x * grid::kLatticeSteps, sample.y * grid::kLatticeSteps, 0};
  }
  /// The slopes of scattered samples around a place, in unit() per kLatticeSteps.
  std::array<double, 2> point_slope(const FitCorner& place) const;

  /// Number of fields whose errors count; 1 for heights only.
  std::size_t field_count() const;
  Norm norm() const;
  /// Scaled value of a field at a sample, so that errors can be compared with limit_at().
  double value_at(std::size_t field, Point sample) const {
    return norm_ == nullptr ? double{height_at(sample)} : norm_value_at(field, sample);
  }
  double value_at(std::size_t field, const FitCorner& corner) const {
    if (norm_ == nullptr) return double{corner.z};
    return norm_value_at(field, {corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps});
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

  grid::Raster raster_;
  grid::Raster bounds_;  // parallel to the samples
  Point first_;
  double threshold_, limit_, unit_;
  ErrorRule::Power power_;
  float per_threshold_, per_square_;  // 0 if squares exceed the range of float32
  const float* end_;
  const TriangleKernels* kernels_;  // kernels of one threshold
  const NormError* norm_ = nullptr;
  const ScatteredErrors* points_ = nullptr;
};

}  // namespace scarp::fit
