// The interface of fitting to samples without a grid. point_error.h implements it for points. Builds that fit only
// rasters do not link the implementation.
#pragma once

#include <array>
#include <memory>

#include "base/point.h"
#include "fit/patch.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

/// The errors of trial triangles at the samples under a patch.
class ScatteredErrors {
 public:
  using Corners = std::array<FitCorner, 3>;

  virtual ~ScatteredErrors() = default;

  /// Like the functions of TriangleError with these names. `limit`: slack × threshold. The implementation chooses how a
  /// `Point` identifies a sample.
  virtual TriangleError::Verdict assess(const Corners& corners, float energy_limit, double limit,
                                        ErrorRule::Power power) const = 0;
  virtual TriangleError::Pull pull(const Corners& corners, ErrorRule::Power power) const = 0;
  virtual void add_moments(const Corners& corners, ErrorRule::Power power, TriangleError::Moments& moments) const = 0;
  virtual void narrow(const Corners& corners, TriangleError::Room& room) const = 0;

  virtual double threshold() const = 0;
  virtual FitCorner at(Point sample) const = 0;
  virtual Point nearest(const FitCorner& place) const = 0;
  /// The slopes of the least-squares plane through the samples around a place, in height per kLatticeSteps; 0 if there
  /// are too few.
  virtual std::array<double, 2> slope_at(const FitCorner& place) const = 0;
};

/// All samples, instead of a raster's. They lie on the lattice of fitting.
class ScatteredSamples {
 public:
  /// `last`: the last column and row of the lattice. `lowest`, `highest`: the range of the heights.
  ScatteredSamples(Point last, float lowest, float highest) : last_(last), lowest_(lowest), highest_(highest) {}
  virtual ~ScatteredSamples() = default;

  Point last() const { return last_; }
  float lowest() const { return lowest_; }
  float highest() const { return highest_; }

  /// The errors over a window of cells of kLatticeSteps. They are stored in `kept`, and its memory is reused. REQUIRES:
  /// `kept` is empty or from this function; threshold >= 0, finite.
  virtual const ScatteredErrors& over(const Patch::Window& window, double threshold,
                                      std::unique_ptr<ScatteredErrors>& kept) const = 0;

 private:
  Point last_;
  float lowest_, highest_;
};

}  // namespace scarp::fit
