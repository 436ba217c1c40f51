#include "metric/bound_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/exact_arithmetic.h"

namespace scarp::metric {

float round_down_to_float(double value) {
  if (value >= std::numeric_limits<float>::max())
    return std::isinf(value) ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::max();
  const auto rounded = static_cast<float>(value);
  return rounded > value ? std::nextafter(rounded, 0.0f) : rounded;
}

double divide_down(double value, double weight) {
  const double quotient = value / weight;
  const auto [high, low] = exact_product(quotient, weight);
  return high > value || (high == value && low > 0) ? std::nextafter(quotient, 0.0) : quotient;
}

double tightened(double goal, double reserve) {
  return reserve > 0 ? std::max(0.0, std::nextafter(goal - reserve, 0.0)) : goal;
}

float BoundRule::bound(double asked) const {
  return round_down_to_float(std::isinf(asked) ? asked : tightened(asked, reserve));
}

float BoundRule::aim_at(float bound) const { return std::isinf(bound) ? bound : round_down_to_float(aim * bound); }

Error BoundRule::refuse(Point at, double asked) const {
  return {ErrorKind::kPromise,
          fmt::format("the bound at sample ({}, {}) is {}, but the raster's values do not fit float32 and are rounded "
                      "by up to {}; allow at least that much",
                      at.x, at.y, asked, reserve)};
}

Error refuse_value(const char* what, Point at, float value, const char* rest) {
  return {ErrorKind::kUsage,
          fmt::format("{} at sample ({}, {}) is {}: it must be at least 0{}", what, at.x, at.y, value, rest)};
}

}  // namespace scarp::metric
