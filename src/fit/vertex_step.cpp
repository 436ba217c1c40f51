#include "fit/vertex_step.h"

#include <algorithm>
#include <cmath>

#include "fit/height_step.h"

namespace scarp {

namespace {

/// Of the energy before: what must be gained.
constexpr float kGain = 2e-3f;
/// Lengths of a step: times Newton's, but at most this share of the mean edge.
constexpr std::array<double, 3> kLengths{1.5, 0.45, 0.12};
constexpr std::array<double, 3> kReaches{0.4, 0.12, 0.032};

Point sample_at(const FitCorner& corner) { return {corner.x / kLatticeSteps, corner.y / kLatticeSteps}; }

/// Between samples, by bilinear interpolation; NaN beside a void.
float terrain_height(const TriangleError& error, const Patch::Window& window, const FitCorner& place) {
  const Point p = sample_at(place);
  const Point q{std::min(p.x + 1, window.cols - 1), std::min(p.y + 1, window.rows - 1)};
  const float x = static_cast<float>(place.x % kLatticeSteps) / kLatticeSteps;
  const float y = static_cast<float>(place.y % kLatticeSteps) / kLatticeSteps;
  const float above = error.height_at(p) * (1 - x) + error.height_at({q.x, p.y}) * x;
  const float below = error.height_at({p.x, q.y}) * (1 - x) + error.height_at(q) * x;
  return above * (1 - y) + below * y;
}

/// Σ A u uᵀ d = −Σ B u for d = (z, x, y).
class NormalEquations {
 public:
  using Row = std::array<double, 3>;

  void add(const TriangleError::Pull& pull, const Row& u) {
    for (std::size_t i = 0; i < 3; ++i) {
      right_[i] -= pull.push * u[i];
      for (std::size_t j = 0; j < 3; ++j) left_[i][j] += pull.stiffness * u[i] * u[j];
    }
  }
  /// Keeps it solvable where the samples say nothing about a direction.
  void damp() {
    constexpr double kPlaces = 1e-3, kHeights = 1e-4;
    const double damping = kPlaces * (left_[1][1] + left_[2][2]);
    left_[0][0] *= 1 + kHeights;
    left_[1][1] += damping;
    left_[2][2] += damping;
  }
  void fix(std::size_t k) {
    for (std::size_t i = 0; i < 3; ++i) left_[k][i] = left_[i][k] = 0;
    left_[k][k] = 1;
    right_[k] = 0;
  }
  /// By Cramer's rule; zeros where there is no solution.
  Row solve() const {
    const double det = determinant(left_);
    if (!(std::abs(det) > 0)) return {};
    Row solution;
    for (std::size_t k = 0; k < 3; ++k) {
      auto replaced = left_;
      for (std::size_t i = 0; i < 3; ++i) replaced[i][k] = right_[i];
      solution[k] = determinant(replaced) / det;
    }
    return solution;
  }

 private:
  using Matrix = std::array<Row, 3>;
  static double determinant(const Matrix& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  Matrix left_{};
  Row right_{};
};

/// The nearest place in the direction of a step that is too short for one.
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
VertexStep::Vector VertexStep::newton_step(const TriangleError& error, const FitCorner& at) const {
  const bool is_free = freedom_ == Freedom::kLattice;
  const Vector terrain = is_free ? Vector{} : terrain_slope(error, at);
  NormalEquations system;
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    const auto pull = error.pull(at, ring(i), ring(i + 1));
    system.add(pull, {is_free ? 1.0 : 0.0, terrain.x - pull.slope_x, terrain.y - pull.slope_y});
  }
  system.damp();
  if (!is_free) system.fix(0);
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

bool VertexStep::improve(const TriangleError& error, Patch::Id v) {
  if (patch_.is_locked(v)) return false;
  patch_.find_star(v, star_);
  if (!star_.closed && star_.side != Patch::kSide) return false;
  float limit = 0;
  for (const Patch::Id f : star_.faces) limit += patch_.face(f).energy;
  limit *= 1 - kGain;
  const FitCorner from = patch_.at(v);
  const Vector step = newton_step(error, from);
  const double length = std::sqrt(step.x * step.x + step.y * step.y) * kLatticeSteps;
  const std::int32_t unit = freedom_ == Freedom::kLattice ? 1 : kLatticeSteps;
  const double edge = mean_edge(from);
  Point last{0, 0};
  for (std::size_t i = 0; length > 0 && length < 1e9 && i < kLengths.size(); ++i) {
    const double scale = std::min(kLengths[i], kReaches[i] * edge / length) * kLatticeSteps / unit;
    Point by{static_cast<std::int32_t>(std::lround(step.x * scale)),
             static_cast<std::int32_t>(std::lround(step.y * scale))};
    if (by == Point{0, 0}) by = unit_step(step.x, step.y);
    if (by == last) continue;
    last = by;
    FitCorner place{from.x + by.x * unit, from.y + by.y * unit, 0};
    if (fits(place) && find_height(error, from, place, limit) && try_place(error, v, place, limit)) return true;
  }
  if (freedom_ == Freedom::kSamples) return false;
  FitCorner place = from;
  return find_height(error, from, place, limit) && place.z != from.z && try_place(error, v, place, limit);
}

/// Whether the star's triangles stay positive.
bool VertexStep::fits(const FitCorner& place) const {
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    if (area2(place, ring(i), ring(i + 1)) <= 0) return false;
  }
  return true;
}

/// Gives the place its height; false where that cannot bring the energy below the limit.
bool VertexStep::find_height(const TriangleError& error, const FitCorner& from, FitCorner& place, float limit) const {
  if (freedom_ == Freedom::kSamples) {
    place.z = error.height_at(sample_at(place));
    return std::abs(place.z) <= kMaxScanHeight;
  }
  const float rise = terrain_height(error, patch_.window(), place) - terrain_height(error, patch_.window(), from);
  place.z = std::isnan(rise) ? from.z : from.z + rise;
  TriangleError::Moments moments{};
  for (std::size_t i = 0; i < star_.faces.size(); ++i) error.add_moments(place, ring(i), ring(i + 1), moments);
  const HeightStep best = best_height(moments);
  place.z = static_cast<float>(double{place.z} + best.rise * error.threshold());
  return best.energy < double{limit} && std::abs(place.z) <= kMaxScanHeight;
}

bool VertexStep::try_place(const TriangleError& error, Patch::Id v, FitCorner place, float limit) {
  verdicts_.clear();
  for (std::size_t i = 0; i < star_.faces.size(); ++i) {
    verdicts_.push_back(error.judge(place, ring(i), ring(i + 1), limit));
    if (verdicts_.back().kind != TriangleError::Verdict::Kind::kKeeps) return false;
    limit -= verdicts_.back().energy;
  }
  patch_.move(v, place);
  for (std::size_t i = 0; i < star_.faces.size(); ++i)
    patch_.set_measure(star_.faces[i], verdicts_[i].worst, verdicts_[i].energy);
  return true;
}

}  // namespace scarp
