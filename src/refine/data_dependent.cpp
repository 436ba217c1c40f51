#include "refine/data_dependent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/quadrilateral.h"

namespace scarp::refine {

namespace {

/// Each flip lowers the total score, so a chain of flips ends; a long chain is not worth its scans.
constexpr std::size_t kMostFlips = 64;

double default_threshold(EdgeScore score) { return score == EdgeScore::kTight ? 0.1 : 0.5; }

}  // namespace

/// Flips by score only, if no triangle becomes too thin.
struct DataDependentRule::Improver final : public tin::FlipRule {
  explicit Improver(DataDependentRule& owner_) : owner(owner_) {}
  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const Quadrilateral quad(tin, h);
    if (!quad.can_flip() || tin.is_outside(quad.t) || fatness(quad.other) < owner.threshold_) return false;
    if (!owner.is_better(tin, h)) return false;
    owner.changed_.push_back(quad.t);
    owner.changed_.push_back(quad.u);
    return true;
  }
  DataDependentRule& owner;
};

DataDependentRule::DataDependentRule(const metric::ErrorMetric& metric, const EdgeRule& rule)
    : metric_(metric),
      rule_(rule),
      threshold_(rule.shape_threshold < 0 ? default_threshold(rule.score) : rule.shape_threshold),
      cache_(metric, rule.score == EdgeScore::kSquares, rule.supersample) {}

tin::Vertex DataDependentRule::insert(tin::Triangulation& tin, Point p, tin::Triangulation::Location location) {
  const tin::Vertex v = tin.insert(p, location, this);
  tin.star(v, changed_);
  if (rule_.score != EdgeScore::kTight) return v;
  std::vector<tin::HalfEdge> edges;
  for (tin::Triangle t : changed_) {
    if (tin.is_outside(t)) continue;
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      // A spoke belongs to two triangles of the star, but is tested once.
      const bool is_spoke = tin.origin(h) == v || tin.origin(tin::Triangulation::next(h)) == v;
      if (!is_spoke || h < tin.twin(h)) edges.push_back(h);
    }
  }
  Improver improver(*this);
  tin.improve(edges, improver, kMostFlips);
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  return v;
}

bool DataDependentRule::should_flip(const tin::Triangulation& tin, tin::HalfEdge h) {
  const Quadrilateral quad(tin, h);
  if (!quad.can_flip()) return false;
  if (tin.is_outside(quad.t)) {
    const auto [a, b, c] = quad.kept[0];
    return geom::in_circle(a, b, c, quad.kept[1][2]) > 0;
  }
  if (rule_.score == EdgeScore::kTight) {
    const double kept = fatness(quad.kept), other = fatness(quad.other);
    if (std::min(kept, other) < threshold_) return other > kept;
  } else {
    const double kept = box_quality(quad.kept[0]) * box_quality(quad.kept[1]);
    const double other = box_quality(quad.other[0]) * box_quality(quad.other[1]);
    if (!(std::min(kept, other) / std::max(kept, other) > threshold_)) return other > kept;
  }
  return is_better(tin, h);
}

double DataDependentRule::part(const metric::Fit& fit) const {
  switch (rule_.score) {
    case EdgeScore::kSquares:
      return fit.sum_squares;
    case EdgeScore::kTight:
      return fit.max_error * fit.max_error;
    default:
      return fit.max_error;
  }
}

double DataDependentRule::combine(double first, double second) const {
  return rule_.score == EdgeScore::kMax ? std::max(first, second) : first + second;
}

bool DataDependentRule::is_better(const tin::Triangulation& tin, tin::HalfEdge h) {
  const Quadrilateral quad(tin, h);
  if (rule_.score == EdgeScore::kNormals)
    return metric_.bend(quad.other[0], quad.other[1]) < metric_.bend(quad.kept[0], quad.kept[1]);
  const double first_kept = part(cache_.fit_of(tin, quad.t)), second_kept = part(cache_.fit_of(tin, quad.u));
  double score = combine(first_kept, second_kept);
  if (rule_.score == EdgeScore::kSquares) {
    // Both triangles count the samples on the edge between them.
    score -= metric_.squares_between(quad.kept[0][0], quad.kept[0][1]);
    score += metric_.squares_between(quad.other[0][0], quad.other[0][1]);
  }
  // A scan may stop once its triangle alone decides against the flip; the slightly larger limit defers ties to the
  // comparison of sums.
  const auto look = [&](const Quadrilateral::Corners& corners, double most) {
    const double limit = most + 0x1p-40 * score;
    return cache_.look(corners, rule_.score == EdgeScore::kTight ? std::sqrt(limit) : limit);
  };
  const metric::Fit first = look(quad.other[0], score);
  if (!first.complete) return false;
  const metric::Fit second = look(quad.other[1], rule_.score == EdgeScore::kMax ? score : score - part(first));
  if (!second.complete || !(combine(part(first), part(second)) < score)) return false;
  cache_.remember(quad.t, quad.first_vertices, first);
  cache_.remember(quad.u, quad.second_vertices, second);
  return true;
}

}  // namespace scarp::refine
