#include "measure/error_weigher.h"

#include <algorithm>
#include <cmath>

namespace scarp::judge {

double weigh_by_mask(float weight, double error) { return static_cast<double>(weight) * error; }
double weigh_by_tolerance(float tolerance, double error) {
  return error == 0 ? 0 : error / static_cast<double>(tolerance);
}

namespace {

double weigh(const ErrorWeigher::Row& row, std::size_t k, double error) {
  if (!row.mask.empty()) return weigh_by_mask(row.mask[k], error);
  return row.tolerance.empty() ? error : weigh_by_tolerance(row.tolerance[k], error);
}

}  // namespace

ErrorWeigher::ErrorWeigher(double bound, double reserve, double allowance)
    : limit_(bound * (1 + std::ldexp(1.0, -23))), reserve_(reserve), allowance_(allowance) {}

void ErrorWeigher::add(int row, const Row& values) {
  for (std::size_t k = 0; k < values.errors.size(); ++k) {
    if (std::isnan(values.errors[k])) continue;
    ++judged_;
    const double error = values.norms.empty() ? std::abs(static_cast<double>(values.errors[k])) : values.norms[k];
    const double value = weigh(values, k, error);
    sum_of_squares_ += value * value;
    const LargestError here{value, {static_cast<std::int32_t>(k), row}};
    if (value > weighed_.largest.value) weighed_.largest = here;
    if (!values.limits.empty() && values.limits[k] > 0) continue;
    if (value > weighed_.bounded.value) weighed_.bounded = here;
    if (weigh(values, k, std::max(0.0, error + reserve_ - allowance_)) > limit_) ++weighed_.over;
  }
}

WeighedErrors ErrorWeigher::finish() const {
  WeighedErrors weighed = weighed_;
  if (judged_ > 0) weighed.rmse = std::sqrt(sum_of_squares_ / static_cast<double>(judged_));
  return weighed;
}

}  // namespace scarp::judge
