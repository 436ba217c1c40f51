#include "fit/vertex_step.h"

#include <algorithm>
#include <cmath>

namespace scarp {

namespace {

/// Of the energy before: what must be gained.
constexpr float kGain = 2e-3f;
/// Lengths of a step: times Newton's, but at most this share of the mean edge.
constexpr std::array<double, 3> kLengths{1.5, 0.45, 0.12};
constexpr std::array<double, 3> kReaches{0.4, 0.12, 0.032};
/// Keeps the system solvable where the samples say nothing about a direction.
constexpr double kDamping = 1e-3;

Point sample_at(const FitCorner& corner) { return {corner.x / kLatticeSteps, corner.y / kLatticeSteps}; }

/// The nearest sample in the direction of a step that is too short for one.
Point unit_step(double x, double y) {
  const std::int32_t right = x > 0 ? 1 : -1, down = y > 0 ? 1 : -1;
  constexpr double kDiagonal = 0.4;
  if (std::abs(x) > kDiagonal * std::abs(y) && std::abs(y) > kDiagonal * std::abs(x)) return {right, down};
  return std::abs(x) >= std::abs(y) ? Point{right, 0} : Point{0, down};
}

}  // namespace

/// Central differences, in thresholds a sample; 0 where samples are void or beyond the window.
VertexStep::Vector VertexStep::terrain_slope(const TriangleError& error, const FitCorner& at) const {
  const auto& window = patch_.window();
  const Point p = sample_at(at);
  const auto slope = [&](Point before, Point after) {
    before = {std::max(before.x, 0), std::max(before.y, 0)};
    after = {std::min(after.x, window.cols - 1), std::min(after.y, window.rows - 1)};
    const double rise = double{error.height_at(after)} - double{error.height_at(before)};
    const std::int32_t run = (after.x - before.x) + (after.y - before.y);
    return run == 0 || std::isnan(rise) ? 0.0 : rise / run / error.threshold();
  };
  return {slope({p.x - 1, p.y}, {p.x + 1, p.y}), slope({p.x, p.y - 1}, {p.x, p.y + 1})};
}

/// In samples; along the side for a vertex on one.
VertexStep::Vector VertexStep::newton_step(const TriangleError& error, Patch::Id v) const {
  const FitCorner& at = patch_.at(v);
  const Vector terrain = terrain_slope(error, at);
  double xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    const auto pull = error.pull(at, patch_.at(star_.ring[i]), patch_.at(star_.ring[(i + 1) % star_.ring.size()]));
    const double ux = terrain.x - pull.slope_x, uy = terrain.y - pull.slope_y;
    xx += pull.stiffness * ux * ux;
    xy += pull.stiffness * ux * uy;
    yy += pull.stiffness * uy * uy;
    bx -= pull.push * ux;
    by -= pull.push * uy;
  }
  const double damping = kDamping * (xx + yy);
  xx += damping;
  yy += damping;
  if (!star_.closed) {
    const bool is_level = patch_.at(star_.ring.front()).y == at.y;
    return is_level ? Vector{xx > 0 ? bx / xx : 0, 0} : Vector{0, yy > 0 ? by / yy : 0};
  }
  const double det = xx * yy - xy * xy;
  if (!(det > 0)) return {};
  return {(bx * yy - by * xy) / det, (by * xx - bx * xy) / det};
}

double VertexStep::mean_edge(Patch::Id v) const {
  const FitCorner& at = patch_.at(v);
  double sum = 0;
  for (const Patch::Id u : star_.ring) {
    const double x = patch_.at(u).x - at.x, y = patch_.at(u).y - at.y;
    sum += std::sqrt(x * x + y * y);
  }
  return sum / (kLatticeSteps * static_cast<double>(star_.ring.size()));
}

bool VertexStep::improve(const TriangleError& error, Patch::Id v) {
  if (patch_.is_locked(v)) return false;
  patch_.find_star(v, star_);
  if (!star_.closed && star_.side != Patch::kSide) return false;
  float limit = 0;
  for (const Patch::Id f : star_.faces) limit += patch_.face(f).energy;
  limit *= 1 - kGain;
  const Vector step = newton_step(error, v);
  const double length = std::sqrt(step.x * step.x + step.y * step.y);
  if (!(length > 0 && length < 1e9)) return false;
  const double edge = mean_edge(v);
  const FitCorner from = patch_.at(v);
  Point last{0, 0};
  for (std::size_t i = 0; i < kLengths.size(); ++i) {
    const double scale = std::min(kLengths[i], kReaches[i] * edge / length);
    Point by{static_cast<std::int32_t>(std::lround(step.x * scale)),
             static_cast<std::int32_t>(std::lround(step.y * scale))};
    if (by == Point{0, 0}) by = unit_step(step.x, step.y);
    if (by == last) continue;
    last = by;
    FitCorner to{from.x + by.x * kLatticeSteps, from.y + by.y * kLatticeSteps, 0};
    if (try_place(error, v, to, limit)) return true;
  }
  return false;
}

bool VertexStep::try_place(const TriangleError& error, Patch::Id v, const FitCorner& to, float limit) {
  const std::size_t count = star_.ring.size();
  const auto next = [&](std::size_t i) -> const FitCorner& { return patch_.at(star_.ring[(i + 1) % count]); };
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    if (area2(to, patch_.at(star_.ring[i]), next(i)) <= 0) return false;
  }
  FitCorner place = to;
  place.z = error.height_at(sample_at(to));
  if (!(std::abs(place.z) <= kMaxScanHeight)) return false;
  verdicts_.clear();
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    verdicts_.push_back(error.judge(place, patch_.at(star_.ring[i]), next(i), limit));
    if (verdicts_.back().kind != TriangleError::Verdict::Kind::kKeeps) return false;
    limit -= verdicts_.back().energy;
  }
  patch_.move(v, place);
  for (std::size_t i = 0; i < star_.faces.size(); ++i)
    patch_.set_measure(star_.faces[i], verdicts_[i].worst, verdicts_[i].energy);
  return true;
}

}  // namespace scarp
