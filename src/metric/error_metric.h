// The error metric measures how well a triangle fits the samples. The engine accesses samples only through it.
//
// All error options (weights, tolerances, importance, channels) are implemented behind this interface. Refinement,
// batches and data-dependent edges do not depend on them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/point.h"
#include "metric/candidate.h"

namespace scarp::metric {

/// The fit of a triangle to the samples in it (closed: samples on its edges count).
struct Fit {
  Candidate worst{-1, {}};    ///< the most important sample; error < 0: none
  double guard = 0;           ///< bound of |worst.error − exact error|
  double max_error = 0;       ///< largest error, for edge scores
  double sum_squares = 0;     ///< sum of squared errors, for edge scores; if requested
  std::uint64_t scanned = 0;  ///< number of samples scanned
  bool unsettled = false;     ///< true if exact arithmetic must decide whether `worst` is the candidate
  bool complete = true;       ///< false: stopped early, since max_error or sum_squares is above its limit
};

/// The parameters of a scan.
struct FitQuestion {
  bool squares = false;
  int lattice = 1;  ///< for scores: factor by which the lattice of errors is finer
  double give_up_max = std::numeric_limits<double>::infinity();
  double give_up_squares = std::numeric_limits<double>::infinity();

  /// True if a scan with these results may stop early; never without limits.
  bool is_given_up(double max_error, double sum_squares) const {
    return (!(max_error < give_up_max) && give_up_max != std::numeric_limits<double>::infinity()) ||
           (!(sum_squares < give_up_squares) && give_up_squares != std::numeric_limits<double>::infinity());
  }
};

class ErrorMetric {
 public:
  virtual ~ErrorMetric() = default;
  /// REQUIRES: corners are valid samples, orient(corners) > 0.
  virtual Fit fit(const std::array<Point, 3>& corners, const FitQuestion& question) const = 0;
  /// The most important sample that exceeds its bound in exact arithmetic, if any. `fit` is this metric's complete fit
  /// of the same corners.
  virtual std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const = 0;
  /// The importance of a sample exactly at its bound, if importance is an error; else 0.
  virtual double goal() const = 0;
  /// Sum of the squared errors (as in Fit) of the samples on the straight edge between two samples, without its ends.
  /// The fits of both triangles at the edge include these errors.
  virtual double squares_between(Point a, Point b) const = 0;
  /// The bend of the surface between triangles a and b: |n_a − n_b|² of their unit normals, which grows with the angle.
  /// With channels: the scaled sum over all fields.
  virtual double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const = 0;
};

}  // namespace scarp::metric
