#include "fit/vertex_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "fit/normal_equations.h"

namespace scarp::fit {

namespace {

/// Least gain, as a share of the energy before.
constexpr float kStepGain = 2e-3f;
/// Lengths of a step, relative to Newton's step, and limited to a share of the mean edge.
struct Length {
  double times, reach;
};
constexpr std::array<Length, 3> kOfSquares{{{1.5, 0.4}, {0.45, 0.12}, {0.12, 0.032}}};
/// With eighth powers, most of the longest steps fail.
constexpr std::array<Length, 2> kFree{{{0.45, 0.12}, {0.12, 0.032}}}, kOnSamples{{{1, 0.3}, {0.3, 0.1}}};

std::span<const Length> lengths_of(ErrorRule::Power power, bool is_free) {
  if (power == ErrorRule::Power::kTwo) return kOfSquares;
  return is_free ? kFree : kOnSamples;
}

constexpr std::array<Point, 8> kStepWays{Point{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};

/// Limits of a shake: energy relative to before, and distance relative to the mean edge.
constexpr float kShakeCost = 3;
constexpr double kShakeReach = 0.05;

Point sample_at(const FitCorner& corner) { return {corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps}; }

/// Bilinear interpolation between samples; NaN next to nodata.
float terrain_height(const TriangleError& error, const Patch::Window& window, const FitCorner& place) {
  const Point p = sample_at(place);
  const Point q{std::min(p.x + 1, window.cols - 1), std::min(p.y + 1, window.rows - 1)};
  const float x = static_cast<float>(place.x % grid::kLatticeSteps) / grid::kLatticeSteps;
  const float y = static_cast<float>(place.y % grid::kLatticeSteps) / grid::kLatticeSteps;
  const float above = error.height_at(p) * (1 - x) + error.height_at({q.x, p.y}) * x;
  const float below = error.height_at({p.x, q.y}) * (1 - x) + error.height_at(q) * x;
  return above * (1 - y) + below * y;
}

/// The smallest lattice step in the direction of a step that rounds to zero.
Point unit_step(double x, double y) {
  const std::int32_t right = x > 0 ? 1 : -1, down = y > 0 ? 1 : -1;
  constexpr double kDiagonal = 0.4;
  if (std::abs(x) > kDiagonal * std::abs(y) && std::abs(y) > kDiagonal * std::abs(x)) return {right, down};
  return std::abs(x) >= std::abs(y) ? Point{right, 0} : Point{0, down};
}

}  // namespace

/// Central differences, in error units per sample; 0 where samples are nodata or beyond the window.
VertexStep::Vector VertexStep::terrain_slope(const TriangleError& error, std::size_t field, const FitCorner& at) const {
  if (error.has_points()) {
    const auto [x, y] = error.point_slope(at);
    return {x, y};
  }
  const auto& window = patch_.window();
  const Point p = sample_at(at);
  const auto slope = [&](Point before, Point after) {
    before = {std::max(before.x, 0), std::max(before.y, 0)};
    after = {std::min(after.x, window.cols - 1), std::min(after.y, window.rows - 1)};
    const double rise = error.value_at(field, after) - error.value_at(field, before);
    const std::int32_t run = (after.x - before.x) + (after.y - before.y);
    const bool is_known = !std::isnan(error.height_at(after) - error.height_at(before));
    return run == 0 || !is_known ? 0.0 : rise / run / error.unit();
  };
  return {slope({p.x - 1, p.y}, {p.x + 1, p.y}), slope({p.x, p.y - 1}, {p.x, p.y + 1})};
}

/// The step in samples. A vertex on a side moves along this side.
VertexStep::Vector VertexStep::newton_step(const TriangleError& error, const FitCorner& at) {
  terrain_.clear();
  for (std::size_t k = 0; k < error.field_count(); ++k)
    terrain_.push_back(is_free() ? Vector{} : terrain_slope(error, k, at));
  NormalEquations system;
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    error.pull(at, ring(i), ring(i + 1), pulls_);
    for (std::size_t k = 0; k < pulls_.size(); ++k)
      system.add(pulls_[k],
                 {is_free() ? 1.0 : 0.0, terrain_[k].x - pulls_[k].slope_x, terrain_[k].y - pulls_[k].slope_y});
  }
  system.damp();
  if (!is_free()) system.fix(0);
  if (!star_.closed) system.fix(ring(0).y == at.y ? 2 : 1);
  const auto [z, x, y] = system.solve();
  return {x, y};
}

double VertexStep::mean_edge(const FitCorner& at) const {
  double sum = 0;
  for (std::size_t i = 0; i < star_.ring.size(); ++i) {
    const double x = ring(i).x - at.x, y = ring(i).y - at.y;
    sum += std::sqrt(x * x + y * y);
  }
  return sum / static_cast<double>(star_.ring.size());
}

/// Finds the star of a vertex; false if it must not move.
bool VertexStep::take_up(const TriangleError& error, Patch::Id v) {
  if (patch_.is_locked(v)) return false;
  patch_.find_star(v, star_);
  is_over_ = std::any_of(star_.faces.begin(), star_.faces.end(),
                         [&](Patch::Id f) { return patch_.face(f).worst > error.threshold(); });
  return star_.closed || star_.side == Patch::kSide;
}

float VertexStep::energy() const {
  float sum = 0;
  for (const Patch::Id f : star_.faces) sum += patch_.face(f).energy;
  return sum;
}

bool VertexStep::improve(const TriangleError& error, Patch::Id v) {
  if (!take_up(error, v)) return false;
  const float limit = energy() * (1 - kStepGain);
  const FitCorner from = patch_.at(v);
  const Vector step = newton_step(error, from);
  const double length = std::sqrt(step.x * step.x + step.y * step.y) * grid::kLatticeSteps;
  const double edge = mean_edge(from);
  const TriangleShape floor = shape_floor(from);
  Point last{0, 0};
  for (const auto& [times, reach] : lengths_of(error.power(), is_free())) {
    if (!(length > 0 && length < 1e9)) break;
    const double scale = std::min(times, reach * edge / length) * grid::kLatticeSteps / unit();
    Point by{static_cast<std::int32_t>(std::lround(step.x * scale)),
             static_cast<std::int32_t>(std::lround(step.y * scale))};
    if (by == Point{0, 0}) by = unit_step(step.x, step.y);
    if (by == last) continue;
    last = by;
    const FitCorner place = shifted(error, from, by);
    if (fits(place, floor) && take(error, v, offer_at(error, from, place, limit), limit)) return true;
  }
  if (!is_free()) return false;
  const Offer here = offer_at(error, from, from, limit);
  return here.place.z != from.z && take(error, v, here, limit);
}

bool VertexStep::probe(const TriangleError& error, Patch::Id v, double reach) {
  if (!take_up(error, v)) return false;
  const float limit = energy() * (1 - kStepGain);
  const FitCorner from = patch_.at(v);
  const TriangleShape floor = shape_floor(from);
  const auto steps = static_cast<std::int32_t>(std::max(1L, std::lround(reach * mean_edge(from) / unit())));
  Offer best{from, limit};
  for (const Point& way : kStepWays) {
    if (!star_.closed && (ring(0).y == from.y ? way.y : way.x) != 0) continue;
    const FitCorner place = shifted(error, from, {way.x * steps, way.y * steps});
    if (!fits(place, floor)) continue;
    const Offer there = offer_at(error, from, place, limit);
    if (!is_free() && take(error, v, there, limit)) return true;
    if (is_free() && there.energy < best.energy) best = there;
  }
  return take(error, v, best, limit);
}

bool VertexStep::shake(const TriangleError& error, Patch::Id v, std::uint32_t dice) {
  if (!take_up(error, v)) return false;
  const FitCorner from = patch_.at(v);
  const float limit = energy() * kShakeCost;
  const double reach = kShakeReach * mean_edge(from) / unit() / 0x8000;
  const auto part = [&](std::uint32_t bits) {
    return static_cast<std::int32_t>(std::lround(reach * (static_cast<double>(bits & 0xffff) - 0x8000)));
  };
  Point by{part(dice), part(dice >> 16)};
  if (!star_.closed) (ring(0).y == from.y ? by.y : by.x) = 0;
  const FitCorner place = shifted(error, from, by);
  if (by == Point{0, 0} || !fits(place, shape_floor(from))) return false;
  return take(error, v, offer_at(error, from, place, limit), limit);
}

/// The target of a step, or the nearest scattered sample if it is on the vertex's side.
FitCorner VertexStep::shifted(const TriangleError& error, const FitCorner& from, Point by) const {
  const FitCorner to{from.x + by.x * unit(), from.y + by.y * unit(), 0};
  if (is_free() || !error.has_points()) return to;
  const FitCorner sample = error.place_of(error.sample_near(to));
  const bool is_on_side = star_.closed || (ring(0).y == from.y ? sample.y == from.y : sample.x == from.x);
  return is_on_side ? sample : from;
}

/// The floor of shapes for a step of the vertex.
TriangleShape VertexStep::shape_floor(const FitCorner& from) const {
  TriangleShape floor = rules_.shape.least();
  if (!rules_.shape.is_on()) return floor;
  for (std::size_t i = 0; i < star_.faces.size(); ++i) floor = rules_.shape.lowered(floor, from, ring(i), ring(i + 1));
  return floor;
}

bool VertexStep::fits(const FitCorner& place, const TriangleShape& floor) const {
  return fan().fits(place, rules_.shape, floor);
}

/// An initial height: adds the rise of the terrain from the vertex or, with scattered samples, of the vertex's
/// triangle.
float VertexStep::guess_height(const TriangleError& error, const FitCorner& from, const FitCorner& place) const {
  if (!error.has_points()) {
    const float rise = terrain_height(error, patch_.window(), place) - terrain_height(error, patch_.window(), from);
    return std::isnan(rise) ? from.z : from.z + rise;
  }
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    const FitCorner &b = ring(i), &c = ring(i + 1);
    const double of_b = static_cast<double>(area2(from, place, c)), of_c = static_cast<double>(area2(from, b, place));
    if (of_b < 0 || of_c < 0) continue;
    const double rise = (of_b * (double{b.z} - double{from.z}) + of_c * (double{c.z} - double{from.z}));
    return static_cast<float>(double{from.z} + rise / static_cast<double>(area2(from, b, c)));
  }
  return from.z;
}

/// Sets the place's height. If it brings the star within the bound, its energy counts as below the limit.
VertexStep::Offer VertexStep::offer_at(const TriangleError& error, const FitCorner& from, FitCorner place,
                                       float limit) const {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  if (!is_free()) {
    if (!error.has_points()) place.z = error.height_at(sample_at(place));
    return {place, std::abs(place.z) <= geom::kMaxScanHeight ? 0 : kNever};
  }
  place.z = guess_height(error, from, place);
  const auto raised =
      fan().raise(error, rules_, place, [&](double energy) { return seeks_room_ && (is_over_ || energy < limit); });
  const auto energy = static_cast<float>(raised.energy);
  const bool mends = raised.in_room && is_over_ && energy < kNever;
  return {raised.place, mends ? std::min(energy, limit * (1 - kStepGain)) : energy, mends};
}

/// Moves v there if the energy is below the limit and the rule of `error` accepts it.
bool VertexStep::take(const TriangleError& error, Patch::Id v, const Offer& offer, float limit) {
  if (!(offer.energy < limit)) return false;
  if (offer.mends) limit = std::numeric_limits<float>::infinity();
  verdicts_.clear();
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    verdicts_.push_back(error.assess(offer.place, ring(i), ring(i + 1), limit));
    if (verdicts_.back().kind != TriangleError::Verdict::Kind::kKeeps) return false;
    limit -= verdicts_.back().energy;
  }
  patch_.move(v, offer.place);
  for (std::size_t i = 0; i < star_.faces.size(); ++i)
    patch_.set_measure(star_.faces[i], verdicts_[i].worst, verdicts_[i].energy);
  return true;
}

}  // namespace scarp::fit
