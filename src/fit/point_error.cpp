#include "fit/point_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/triangle_scan.h"
#include "fit/triangle_sums.h"
#include "geom/exact_error.h"

namespace scarp::fit {

namespace {

/// Largest error from a sample's rounded place in a new triangle, as a share of the threshold.
constexpr double kRoundingShare = 1.0 / 16;

}  // namespace

/// A triangle ready to be scanned: doubled areas, relative to the first corner.
struct PointError::Task {
  const Corners& corners;
  double x, y, z;              // first corner
  double bx, by, cx, cy;       // the others, relative to it
  double area;                 // twice the triangle's area
  double rise_b, rise_c;       // heights above the first corner, per area
  double guard;                // bound of the rounding of errors
  std::array<double, 3> step;  // change of x per step south along the edge from corner k; 0 for a level edge

  explicit Task(const Corners& of)
      : corners(of),
        x(of[0].x),
        y(of[0].y),
        z(double{of[0].z}),
        bx(of[1].x - x),
        by(of[1].y - y),
        cx(of[2].x - x),
        cy(of[2].y - y),
        area(bx * cy - by * cx),
        rise_b((double{of[1].z} - z) / area),
        rise_c((double{of[2].z} - z) / area),
        guard(0x1p-48 * (std::abs(z) + std::abs(double{of[1].z} - z) + std::abs(double{of[2].z} - z))) {
    for (std::size_t k = 0; k < 3; ++k) {
      const FitCorner &from = of[k], &to = of[k == 2 ? 0 : k + 1];
      step[k] = from.y == to.y ? 0 : (double{1} * to.x - from.x) / (double{1} * to.y - from.y);
    }
  }

  /// Weights of the second and the third corner at a place, times the area; exact.
  struct Weights {
    double b, c;
  };
  Weights weights(double px, double py) const {
    const double dx = px - x, dy = py - y;
    return {dx * cy - dy * cx, bx * dy - by * dx};
  }
  bool holds(const Weights& w) const { return w.b >= 0 && w.c >= 0 && w.b + w.c <= area; }
  /// The height of the plane above the sample.
  double error(const Weights& w, float sample) const { return (z - double{sample}) + (w.b * rise_b + w.c * rise_c); }

  double slope_x() const { return rise_b * cy - rise_c * by; }
  double slope_y() const { return rise_c * bx - rise_b * cx; }
  double slope() const { return std::hypot(slope_x(), slope_y()); }

  /// The western and eastern ends of the triangle between two rows.
  void span(double top, double bottom, double& west, double& east) const {
    west = std::numeric_limits<double>::infinity();
    east = -west;
    for (std::size_t k = 0; k < 3; ++k) {
      const FitCorner &from = corners[k], &to = corners[k == 2 ? 0 : k + 1];
      const double high = std::min(from.y, to.y), low = std::max(from.y, to.y);
      if (low < top || high > bottom) continue;
      const double first = from.x + (std::max(high, top) - from.y) * step[k];
      const double last = from.y == to.y ? to.x : from.x + (std::min(low, bottom) - from.y) * step[k];
      west = std::min({west, first, last});
      east = std::max({east, first, last});
    }
    west -= 1;
    east += 1;
  }
};

void PointError::read(const PointSamples& samples, const Patch::Window& window, double threshold) {
  window_.read(samples, window);
  threshold_ = threshold;
  per_threshold_ = threshold > 0x1p-60 && threshold < 0x1p60 ? 1 / threshold : 0;
  const double rounding = samples.rounding();
  steepest_ = rounding > 0 ? kRoundingShare * threshold / rounding : std::numeric_limits<double>::infinity();
}

/// Calls visit(run) for the runs of buckets under a triangle, from north to south, until it returns false. True if it
/// never did.
template <class Visit>
bool PointError::each_run(const Task& task, const Visit& visit) const {
  const auto& [a, b, c] = task.corners;
  const std::int32_t last = window_.row_of(std::max({a.y, b.y, c.y}));
  for (std::int32_t row = window_.row_of(std::min({a.y, b.y, c.y})); row <= last; ++row) {
    const double top = window_.top_of(row);
    double west = 0, east = 0;
    task.span(top, top + window_.height_of_row(), west, east);
    if (!visit(window_.run(row, west, east))) return false;
  }
  return true;
}

bool PointError::keeps_exactly(const Task& task, std::size_t sample) const {
  std::array<Point, 3> corners;
  std::array<double, 3> heights{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = {task.corners[k].x, task.corners[k].y};
    heights[k] = double{task.corners[k].z};
  }
  const FitCorner at = window_.at(sample);
  return !geom::exceeds_exactly(corners, heights, {at.x, at.y}, double{at.z}, threshold_);
}

PointError::Verdict PointError::assess(const Corners& corners, float energy_limit, double limit,
                                       ErrorRule::Power power) const {
  const Task task(corners);
  const float *const x = window_.x(), *const y = window_.y(), *const z = window_.z();
  const double cut = limit + task.guard;
  const bool is_square = power == ErrorRule::Power::kTwo;
  Verdict verdict;
  double worst = 0, energy = 0;
  const bool is_whole = each_run(task, [&](const PointWindow::Run& run) {
    double largest = cut;
    std::uint32_t witness = run.end;
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      const Task::Weights w = task.weights(double{x[i]}, double{y[i]});
      if (!task.holds(w)) continue;
      const double error = std::abs(task.error(w, z[i]));
      worst = std::max(worst, error);
      if (error > largest) {
        largest = error;
        witness = i;
      }
      const double t = error * per_threshold_, t2 = t * t, t4 = t2 * t2;
      energy += is_square ? t2 : t4 * t4;
    }
    if (witness != run.end) {
      verdict.kind = Verdict::Kind::kBreaks;
      verdict.witness = {static_cast<std::int32_t>(witness), 0};
      return false;
    }
    if (energy >= double{energy_limit}) {
      verdict.kind = Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return verdict;
  bool keeps = worst <= threshold_ + task.guard;
  if (keeps && worst >= threshold_ - task.guard) {
    keeps = each_run(task, [&](const PointWindow::Run& run) {
      for (std::uint32_t i = run.begin; i < run.end; ++i) {
        const Task::Weights w = task.weights(double{x[i]}, double{y[i]});
        if (!task.holds(w) || std::abs(task.error(w, z[i])) < threshold_ - task.guard) continue;
        if (keeps_exactly(task, i)) continue;
        verdict.witness = {static_cast<std::int32_t>(i), 0};
        return false;
      }
      return true;
    });
  }
  if (!keeps && limit == threshold_) {
    verdict.kind = Verdict::Kind::kBreaks;
    return verdict;
  }
  verdict.worst = on_side_of(threshold_, keeps, static_cast<float>(worst));
  if (task.slope() > steepest_) {
    verdict.kind = Verdict::Kind::kBreaks;
    verdict.witness = nearest(corners[0]);
  }
  verdict.energy = static_cast<float>(std::min(energy, double{std::numeric_limits<float>::max()}));
  return verdict;
}

/// Calls sums.add(t, λ) for every four samples: errors in thresholds, and weights of the first corner.
template <class Sums>
Sums PointError::ask(const Corners& corners, Sums sums) const {
  const Task task(corners);
  const float *const x = window_.x(), *const y = window_.y(), *const z = window_.z();
  const double per_area = 1 / task.area;
  Floats errors{}, shares{};
  int count = 0;
  each_run(task, [&](const PointWindow::Run& run) {
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      const Task::Weights w = task.weights(double{x[i]}, double{y[i]});
      if (!task.holds(w)) continue;
      errors[count] = static_cast<float>(task.error(w, z[i]) * per_threshold_);
      shares[count] = static_cast<float>((task.area - w.b - w.c) * per_area);
      if (++count < 4) continue;
      sums.add(errors, shares);
      errors = shares = Floats{};
      count = 0;
    }
    return true;
  });
  if (count > 0) sums.add(errors, shares);
  return sums;
}

TriangleError::Pull PointError::pull(const Corners& corners, ErrorRule::Power power) const {
  const Task task(corners);
  const double scale = grid::kLatticeSteps * per_threshold_;
  const double slope_x = task.slope_x() * scale, slope_y = task.slope_y() * scale;
  const auto pull_of = [&](const auto& sums) {
    return TriangleError::Pull{exact_sum_of(sums.stiffness), exact_sum_of(sums.push), slope_x, slope_y};
  };
  return power == ErrorRule::Power::kTwo ? pull_of(ask(corners, SquarePull{})) : pull_of(ask(corners, EighthPull{}));
}

void PointError::add_moments(const Corners& corners, ErrorRule::Power power, TriangleError::Moments& moments) const {
  if (power == ErrorRule::Power::kTwo) {
    add_up(ask(corners, SquareMoments{}), moments);
  } else {
    add_up(ask(corners, EighthMoments{}), moments);
  }
}

void PointError::narrow(const Corners& corners, TriangleError::Room& room) const {
  room = ask(corners, RoomLeft(room)).room();
}

std::array<double, 2> PointError::slope_at(const FitCorner& place) const {
  const double side = window_.height_of_row();
  const std::int32_t row = window_.row_of(place.y);
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, sx = 0, sy = 0, sz = 0;
  int count = 0;
  for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, window_.rows() - 1); ++r) {
    const auto run = window_.run(r, place.x - side, place.x + side);
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      const double x = double{window_.x()[i]} - place.x, y = double{window_.y()[i]} - place.y;
      const double z = double{window_.z()[i]} - double{place.z};
      sx += x, sy += y, sz += z;
      xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z;
      ++count;
    }
  }
  if (count < 3) return {0, 0};
  const double n = count;
  xx -= sx * sx / n, xy -= sx * sy / n, yy -= sy * sy / n, xz -= sx * sz / n, yz -= sy * sz / n;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * xx * yy)) return {0, 0};
  return {(xz * yy - yz * xy) / determinant * grid::kLatticeSteps,
          (yz * xx - xz * xy) / determinant * grid::kLatticeSteps};
}

}  // namespace scarp::fit
