// Errors of the samples of one trial triangle, with heights and channels combined.
//
// Each field has its own plane through its values at the corners, which are samples. The error of a sample is the norm
// of the fields' errors, each multiplied by its scale. As for heights only (triangle_error.h), the scan uses float32,
// eight samples at a time, and ends at the first row that breaks the bound. Within the guard of the bound, the error
// metric of refinement decides (FitNorm::find_breach), so fitting accepts the same triangles as refinement.
//
// The unit of errors is the threshold or, if samples have bounds, a power of two near these bounds. The guard is a sum
// of two parts: the planes' guards for a threshold of 0 (scan_plane.h), multiplied by their scales, and roundings that
// grow with the norm. With u = 2⁻²⁴ these roundings are 5u for each error, u for a scale, u for its product, mu for the
// sum of m fields, and 6u for squares, roots and the bound. The total is less than (m + 12)u; kWidening is twice as
// much.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/fit_norm.h"
#include "fit/triangle_error.h"
#include "grid/raster.h"

namespace scarp::fit {

struct NormScan;
struct NormPlanes;

class NormError {
 public:
  using Corners = std::array<FitCorner, 3>;
  using Verdict = TriangleError::Verdict;
  using Pull = TriangleError::Pull;

  /// The samples under the triangles, in the raster or copied from it.
  struct Samples {
    grid::Raster heights;              ///< decides which samples are valid
    std::vector<const float*> fields;  ///< in the order of the norm, each parallel to the heights
    Point first;                       ///< origin from which corners are counted
    Point origin;                      ///< the same sample in the whole raster
  };
  /// One threshold for all samples. The arguments' data must outlive this object. REQUIRES: threshold >= 0, finite.
  NormError(const FitNorm& norm, Samples samples, double threshold);
  /// Bounds parallel to the heights.
  NormError(const FitNorm& norm, Samples samples, const SampleBounds& bounds);

  /// Like TriangleError::assess(), with errors, slack and energies of the norm, counted in bounds. Without energies,
  /// and where values are beyond kMaxScanHeight, slack is 1. REQUIRES: corners are samples; positive.
  Verdict assess(const Corners& corners, float energy_limit, const ErrorRule& rule) const;

  /// The pull of the samples on the first corner, a Pull for each field: the energy's derivatives for the norms of
  /// squares and of the largest error, whose eighth powers are summed. Norm::kSum uses the formula of the squares.
  /// REQUIRES, cost: as for assess().
  void pull(const Corners& corners, ErrorRule::Power power, std::vector<Pull>& pulls) const;

  const grid::Raster& heights() const { return samples_.heights; }
  Point first() const { return samples_.first; }
  Norm norm() const { return norm_.norm; }
  std::size_t field_count() const { return norm_.fields.size(); }
  bool has_energy() const { return per_unit_ > 0; }
  double unit() const { return unit_; }
  /// Value of a sample counted from the first of the window, in the unit of the heights' errors.
  double value_at(std::size_t field, Point sample) const {
    return norm_.fields[field].scale * double{raw_value_at(field, sample)};
  }
  double bound_at(Point sample) const {
    return bounds_.samples == nullptr ? unit_
                                      : double{bounds_.at({samples_.first.x + sample.x, samples_.first.y + sample.y})};
  }

 private:
  NormScan scan() const;
  template <Norm kNorm>
  Verdict assess_by(const NormPlanes& planes, float energy_limit, const ErrorRule& rule) const;
  Verdict assess_slowly(const Corners& corners, float energy_limit) const;
  std::optional<Point> find_breach(const Corners& corners) const;
  float raw_value_at(std::size_t field, Point sample) const {
    return samples_.fields[field][static_cast<std::size_t>(samples_.first.y + sample.y) *
                                      static_cast<std::size_t>(samples_.heights.cols) +
                                  static_cast<std::size_t>(samples_.first.x + sample.x)];
  }

  const FitNorm& norm_;
  Samples samples_;
  grid::Raster bounds_;
  double unit_;
  double per_unit_;  // 0: errors have no energy, and find_breach decides all
};

}  // namespace scarp::fit
