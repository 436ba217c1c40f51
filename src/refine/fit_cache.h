// The known fits of triangles, so that no triangle is scanned twice for the same question.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "metric/error_metric.h"
#include "metric/fine_lattice.h"
#include "tin/triangulation.h"

namespace scarp::refine {

class FitCache {
 public:
  /// The metric must outlive this. `supersample`: see EdgeRule.
  FitCache(const metric::ErrorMetric& metric, bool squares, double supersample)
      : metric_(metric), squares_(squares), supersample_(supersample) {}

  /// Fit of a triangle that is not outside: cached, or computed now. Valid until the next call.
  const metric::Fit& fit_of(const tin::Triangulation& tin, tin::Triangle t) {
    const std::array<tin::Vertex, 3> corners{tin.origin(3 * t), tin.origin(3 * t + 1), tin.origin(3 * t + 2)};
    if (t >= known_.size() || known_[t].corners != ascending(corners)) remember(t, corners, look(tin.corners(t)));
    return known_[t].fit;
  }
  /// Fit of a possible triangle; the scan stops once its score reaches `give_up`.
  metric::Fit look(const std::array<Point, 3>& corners, double give_up = std::numeric_limits<double>::infinity()) {
    metric::FitQuestion question;
    question.squares = squares_;
    question.lattice = metric::find_lattice(corners, supersample_);
    // On the finer lattice, the score may be smaller than on the samples, so the scan does not stop early.
    if (question.lattice == 1) (squares_ ? question.give_up_squares : question.give_up_max) = give_up;
    const metric::Fit fit = metric_.fit(corners, question);
    samples_ += fit.scanned;
    ++triangles_;
    return fit;
  }
  /// Stores the fit of t, valid while t has these corners.
  void remember(tin::Triangle t, std::array<tin::Vertex, 3> corners, const metric::Fit& fit) {
    if (t >= known_.size()) known_.resize(t + 1);
    known_[t] = {ascending(corners), fit};
  }

  std::uint64_t samples_scanned() const { return samples_; }
  std::uint64_t triangles_scanned() const { return triangles_; }

 private:
  struct Known {
    std::array<tin::Vertex, 3> corners{tin::kNone, tin::kNone, tin::kNone};  // ascending
    metric::Fit fit;
  };
  static std::array<tin::Vertex, 3> ascending(std::array<tin::Vertex, 3> v) {
    if (v[1] < v[0]) std::swap(v[0], v[1]);
    if (v[2] < v[1]) std::swap(v[1], v[2]);
    if (v[1] < v[0]) std::swap(v[0], v[1]);
    return v;
  }

  const metric::ErrorMetric& metric_;
  bool squares_;
  double supersample_;
  std::vector<Known> known_;
  std::uint64_t samples_ = 0, triangles_ = 0;
};

}  // namespace scarp::refine
