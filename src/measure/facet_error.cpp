#include "measure/facet_error.h"

#include <cstddef>

#include "base/exact_arithmetic.h"

namespace scarp::judge {
namespace {

/// An exact sum of doubles: components that do not overlap, smallest first.
struct ExactSum {
  std::array<double, 16> parts{};
  std::size_t count = 0;

  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const ExactPair sum = exact_sum(value, parts[i]);
      if (sum.low != 0) parts[kept++] = sum.low;
      value = sum.high;
    }
    if (value != 0) parts[kept++] = value;
    count = kept;
  }
  void add_product(double a, double b) {
    const ExactPair product = exact_product(a, b);
    add(product.low);
    add(product.high);
  }
  double rounded() const {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += parts[i];
    return sum;
  }
};

}  // namespace

double settle_error(const std::array<double, 3>& w, const std::array<double, 3>& z, double sample) {
  ExactSum rise;
  for (std::size_t k = 0; k < 3; ++k) {
    rise.add_product(w[k], z[k]);
    rise.add_product(-w[k], sample);
  }
  const double area = w[0] + w[1] + w[2];
  const double quotient = rise.rounded() / area;
  if (quotient == 0) return 0;
  ExactSum rest = rise;
  for (std::size_t k = 0; k < 3; ++k) rest.add_product(-quotient, w[k]);
  return quotient + rest.rounded() / area;
}

double error_beside(const Facet& facet, double x, double y, double sample, double tolerance) {
  const PlanTriangle& plan = facet.plan;
  const double area = plan.double_area();
  const double longest = std::max({plan.side(0), plan.side(1), plan.side(2)});
  std::array<double, 3> w{plan.weight(0, x, y), plan.weight(1, x, y), plan.weight(2, x, y)};
  if (area < tolerance * longest) {
    double least = INFINITY;
    for (int k = 0; k < 3; ++k) {
      const int a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
      const double ux = plan.x[b] - plan.x[a], uy = plan.y[b] - plan.y[a], vx = x - plan.x[a], vy = y - plan.y[a];
      const double t = std::clamp((ux * vx + uy * vy) / (ux * ux + uy * uy), 0.0, 1.0);
      const double away = (vx - t * ux) * (vx - t * ux) + (vy - t * uy) * (vy - t * uy);
      if (away >= least) continue;
      least = away;
      w[k] = 0;
      w[a] = 1 - t;
      w[b] = t;
    }
    return w[0] * (facet.z[0] - sample) + w[1] * (facet.z[1] - sample) + w[2] * (facet.z[2] - sample);
  }
  return (w[0] * (facet.z[0] - sample) + w[1] * (facet.z[1] - sample) + w[2] * (facet.z[2] - sample)) / area;
}

}  // namespace scarp::judge
