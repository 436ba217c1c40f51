#include "refine/hull_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "refine/concave_outline.h"

namespace scarp::refine {

namespace {

constexpr std::size_t kMostPoints = 50000;

/// The value that a tenth of the values exceeds.
double ninth_decile(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double ninth_decile_of_edges(const tin::Triangulation& tin) {
  std::vector<double> lengths;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.is_outside(h / 3)) continue;
    const Point a = tin.point(tin.origin(h)), b = tin.point(tin.origin(tin::Triangulation::next(h)));
    lengths.push_back(std::hypot(double(b.x) - a.x, double(b.y) - a.y));
  }
  return ninth_decile(std::move(lengths));
}

double area_of(const tin::Triangulation& tin) {
  double twice = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    if (!tin.is_outside(t)) twice += static_cast<double>(orient(a, b, c));
  }
  return twice / 2;
}

/// Rise over run by triangle, in units of z per unit of x and y; NaN outside.
std::vector<double> find_slopes(const grid::SnappedPoints& points, const ScatteredDomain& domain) {
  const tin::Triangulation& tin = domain.tin;
  const auto z = [&](tin::HalfEdge h) { return points.z[domain.point_of[tin.origin(h)]]; };
  std::vector<double> slopes(tin.triangle_count(), std::numeric_limits<double>::quiet_NaN());
  for (tin::Triangle t = 0; t < slopes.size(); ++t) {
    if (tin.is_outside(t)) continue;
    const auto [a, b, c] = tin.corners(t);
    const double bx = double(b.x) - a.x, by = double(b.y) - a.y, bz = z(3 * t + 1) - z(3 * t);
    const double cx = double(c.x) - a.x, cy = double(c.y) - a.y, cz = z(3 * t + 2) - z(3 * t);
    const double rise = std::hypot(bz * cy - cz * by, bx * cz - cx * bz);
    slopes[t] = rise / (static_cast<double>(orient(a, b, c)) * points.lattice.step);
  }
  return slopes;
}

/// Rounds up to two digits.
double round_up(double length) {
  const double unit = std::pow(10.0, std::floor(std::log10(length)) - 1);
  return std::ceil(length / unit) * unit;
}

}  // namespace

HullFit find_hull_fit(const grid::SnappedPoints& points) {
  ScatteredDomain domain = *build_domain(points);
  add_points(points, points.size() / kMostPoints + 1, domain);
  const tin::Triangulation& tin = domain.tin;
  const double root = std::sqrt(static_cast<double>(domain.vertex_count())), step = points.lattice.step;
  const double whole = area_of(tin), long_edge = ninth_decile_of_edges(tin);
  const std::vector<double> slopes = find_slopes(points, domain);
  HullFit fit;
  take_away_long(domain, 3 * long_edge);
  fit.bridged = 1 - area_of(tin) / whole;
  if (fit.bridged > std::max(0.05, 2.5 / root)) {
    fit.boundary_length = round_up(3 * long_edge * step);
    return fit;
  }
  take_away_long(domain, 1.5 * long_edge);
  std::vector<double> known;
  std::copy_if(slopes.begin(), slopes.end(), std::back_inserter(known), [](double slope) { return slope >= 0; });
  const double steep = std::max(std::tan(80 * std::numbers::pi / 180), 10 * ninth_decile(std::move(known)));
  for (tin::Triangle t = 0; t < slopes.size(); ++t) fit.slivers += tin.is_outside(t) && slopes[t] > steep;
  if (static_cast<double>(fit.slivers) > std::max(10.0, 0.75 * root))
    fit.boundary_length = round_up(1.5 * long_edge * step);
  return fit;
}

}  // namespace scarp::refine
