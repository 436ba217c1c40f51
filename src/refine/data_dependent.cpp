#include "refine/data_dependent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/fine_lattice.h"

namespace scarp {

namespace {

using Corners = std::array<Point, 3>;

double twice_area(const Corners& t) { return static_cast<double>(orient(t[0], t[1], t[2])); }

/// Scape's quality: area / larger side of the bounding box (twice, as only ratios matter).
double box_quality(const Corners& t) {
  const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
  return twice_area(t) / std::max(high_x - low_x, high_y - low_y);
}

/// 2 · area / longest side².
double fatness(const Corners& t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double dx = t[(k + 1) % 3].x - t[k].x, dy = t[(k + 1) % 3].y - t[k].y;
    longest = std::max(longest, dx * dx + dy * dy);
  }
  return twice_area(t) / longest;
}

std::array<Vertex, 3> ascending(std::array<Vertex, 3> v) {
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  if (v[2] < v[1]) std::swap(v[1], v[2]);
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  return v;
}

}  // namespace

DataDependentRule::DataDependentRule(const Judge& judge, const EdgeRule& rule) : judge_(judge), rule_(rule) {
  const double usual = rule.score == EdgeScore::kTight ? 0.2 : 0.5;
  threshold_ = rule.shape_threshold < 0 ? usual : rule.shape_threshold;
}

Fit DataDependentRule::look(const Corners& corners, double give_up) {
  FitQuestion question;
  question.squares = rule_.score == EdgeScore::kSquares;
  question.lattice = find_lattice(corners, rule_.supersample);
  // On the finer lattice the score may turn out smaller than on the samples: it is never given up early.
  if (question.lattice == 1) (question.squares ? question.give_up_squares : question.give_up_max) = give_up;
  const Fit fit = judge_.fit(corners, question);
  samples_ += fit.scanned;
  ++triangles_;
  return fit;
}

void DataDependentRule::remember(Triangle t, std::array<Vertex, 3> corners, const Fit& fit) {
  if (t >= known_.size()) known_.resize(t + 1);
  known_[t] = {ascending(corners), fit};
}

const Fit& DataDependentRule::fit_of(const Triangulation& tin, Triangle t) {
  const std::array<Vertex, 3> ids{tin.origin(3 * t), tin.origin(3 * t + 1), tin.origin(3 * t + 2)};
  if (t >= known_.size() || known_[t].corners != ascending(ids))
    remember(t, ids, look(tin.corners(t), std::numeric_limits<double>::infinity()));
  return known_[t].fit;
}

double DataDependentRule::part(const Fit& fit) const {
  return rule_.score == EdgeScore::kSquares ? fit.sum_squares : fit.max_error;
}

bool DataDependentRule::should_flip(const Triangulation& tin, HalfEdge h) {
  const HalfEdge g = tin.twin(h);
  const Triangle t = h / 3, u = g / 3;
  const Vertex va = tin.origin(h), vb = tin.origin(g), vc = tin.origin(Triangulation::previous(h)),
               vd = tin.origin(Triangulation::previous(g));
  const Point a = tin.point(va), b = tin.point(vb), c = tin.point(vc), d = tin.point(vd);
  const Corners kept[2] = {{a, b, c}, {b, a, d}}, other[2] = {{c, d, b}, {d, c, a}};
  if (twice_area(other[0]) <= 0 || twice_area(other[1]) <= 0) return false;
  if (tin.is_outside(t)) return in_circle(a, b, c, d) > 0;

  if (rule_.score == EdgeScore::kTight) {
    const double kept_shape = std::min(fatness(kept[0]), fatness(kept[1]));
    const double other_shape = std::min(fatness(other[0]), fatness(other[1]));
    if (std::min(kept_shape, other_shape) < threshold_) return other_shape > kept_shape;
  } else {
    const double kept_shape = box_quality(kept[0]) * box_quality(kept[1]);
    const double other_shape = box_quality(other[0]) * box_quality(other[1]);
    const double worse = std::min(kept_shape, other_shape), better = std::max(kept_shape, other_shape);
    if (!(worse > threshold_ * better)) return other_shape > kept_shape;
  }

  if (rule_.score == EdgeScore::kNormals) return judge_.bend(other[0], other[1]) < judge_.bend(kept[0], kept[1]);
  const bool adds = rule_.score == EdgeScore::kSum || rule_.score == EdgeScore::kSquares;
  const double first_kept = part(fit_of(tin, t)), second_kept = part(fit_of(tin, u));
  const double score = adds ? first_kept + second_kept : std::max(first_kept, second_kept);
  const Fit first = look(other[0], score);
  if (!first.complete || !(part(first) < score)) return false;
  const Fit second = look(other[1], adds ? score - part(first) : score);
  if (!second.complete || !((adds ? part(first) + part(second) : std::max(part(first), part(second))) < score))
    return false;
  remember(t, {vc, vd, vb}, first);
  remember(u, {vd, vc, va}, second);
  return true;
}

}  // namespace scarp
