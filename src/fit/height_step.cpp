#include "fit/height_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scarp::fit {

namespace {

constexpr std::array<double, 9> kBinomials{1, 8, 28, 56, 70, 56, 28, 8, 1};
constexpr int kDoublings = 40, kHalvings = 14;

double slope_at(const TriangleError::Moments& moments, double rise) {
  double sum = 0;
  for (std::size_t k = moments.size() - 1; k > 0; --k)
    sum = sum * rise + static_cast<double>(k) * kBinomials[k] * moments[k];
  return sum;
}

}  // namespace

HeightStep best_height(const TriangleError::Moments& moments, double lowest, double highest, double scale) {
  const HeightStep level{0, moments[0]};
  const double slope = slope_at(moments, 0);
  if (slope == 0 || !(moments[8] > 0)) return level;
  const double direction = slope > 0 ? -1 : 1;
  const auto falls_at = [&](double distance) { return slope_at(moments, direction * distance) * direction < 0; };
  double near = 0, far = 0.25 * scale;
  for (int i = 0; i < kDoublings && falls_at(far); ++i) {
    near = far;
    far *= 2;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (near + far) / 2;
    (falls_at(middle) ? near : far) = middle;
  }
  const double rise = std::clamp(direction * (near + far) / 2, lowest, highest);
  const HeightStep best{rise, energy_after(moments, rise)};
  return best.energy < level.energy ? best : level;
}

HeightStep best_even_height(const TriangleError::Moments& moments, double lowest, double highest) {
  if (!(moments[2] > 0)) return {0, moments[0]};
  const double rise = std::clamp(-moments[1] / moments[2], lowest, highest);
  return {rise, std::max(moments[0] + rise * (2 * moments[1] + rise * moments[2]), 0.0)};
}

double energy_after(const TriangleError::Moments& moments, double rise) {
  double sum = 0;
  for (std::size_t k = moments.size(); k-- > 0;) sum = sum * rise + kBinomials[k] * moments[k];
  return sum;
}

double scale_of_rises(const TriangleError::Moments& moments) {
  const double scale = std::sqrt(std::sqrt(std::sqrt(moments[0] / moments[8])));
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

}  // namespace scarp::fit
