// The error metric: it measures how well a triangle fits the samples. The engine reads samples in no other way.
//
// All options of errors (weights, tolerances, importance, channels) are implemented behind this interface; refinement,
// batches and data-dependent edges do not depend on them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/point.h"
#include "metric/candidate.h"

namespace scarp {

/// How well a triangle fits the samples in it (closed: samples on its edges count).
struct Fit {
  Candidate worst{-1, {}};    ///< the most important sample; error < 0: there is none
  double guard = 0;           ///< how far worst.error may be from the real number
  double max_error = 0;       ///< largest error, for edge scores
  double sum_squares = 0;     ///< sum of squares of the errors, for edge scores; where asked for
  std::uint64_t scanned = 0;  ///< number of samples scanned
  bool unsettled = false;     ///< true if an exact computation decides that `worst` is the candidate
  bool complete = true;       ///< false: given up, max_error or sum_squares is above what was asked for
};

/// How carefully to scan a triangle.
struct FitQuestion {
  bool squares = false;
  int lattice = 1;  ///< errors for scores on a lattice this many times finer
  double give_up_max = std::numeric_limits<double>::infinity();
  double give_up_squares = std::numeric_limits<double>::infinity();

  /// True if a scan that has found this much may stop. Without a limit none stops, however large an error is.
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
  /// The most important sample of those that break their bound as real numbers; nothing if none does. `fit` is this
  /// metric's complete fit of the same corners.
  virtual std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const = 0;
  /// The importance of a sample that just keeps the bound, where importance is an error; else 0.
  virtual double goal() const = 0;
  /// Sum of the squared errors (as in Fit) of the samples strictly between two samples on the straight edge that joins
  /// them: what both triangles of the edge count.
  virtual double squares_between(Point a, Point b) const = 0;
  /// How much the surface bends from triangle a to triangle b: |n_a − n_b|² of their unit normals, which grows with the
  /// angle between them. With channels: the scaled sum over all fields.
  virtual double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const = 0;
};

}  // namespace scarp
