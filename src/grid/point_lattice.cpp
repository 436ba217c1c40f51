#include "grid/point_lattice.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

namespace scarp::grid {

namespace {

/// The finest decimals whose multiples are exact doubles and span at most the lattice.
std::optional<Decimals> finest_decimals(const AxisExtent& x, const AxisExtent& y) {
  constexpr int kMostDigits = 22;
  const double reach = std::max(x.reach(), y.reach()), size = std::max(x.size(), y.size());
  for (int digits = kMostDigits; digits >= -kMostDigits; --digits) {
    Decimals decimals{digits, 1};
    for (int k = 0; k < std::abs(digits); ++k) decimals.power *= 10;
    const auto count = [&](double length) { return digits >= 0 ? length * decimals.power : length / decimals.power; };
    if (count(size) < kMaxCoordinate && count(reach) < 0x1p52) return decimals;
  }
  return std::nullopt;
}

}  // namespace

void LatticeFinder::include(const PointSet& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    x_.include(points.x[i]);
    y_.include(points.y[i]);
    z_.include(points.z[i]);
  }
}

Result<void> LatticeFinder::check() {
  constexpr double kReach = 1e100;  // the limit of the arithmetic of planes
  if (std::max({x_.reach(), y_.reach(), z_.reach()}) > kReach)
    return fail(ErrorKind::kInput, "a point has a coordinate beyond 1e100; only smaller ones can be triangulated");
  const double extent = std::max(x_.size(), y_.size());
  if (extent > 0 && extent < 1 / kReach)
    return fail(ErrorKind::kInput,
                fmt::format("all points lie within {} of each other; only a larger extent than 1e-100 can be "
                            "triangulated: give x and y in a smaller unit",
                            extent));
  decimals_ = finest_decimals(x_, y_);
  for (const auto& [value, multiple] : {std::pair{x_.least, &west_}, std::pair{x_.most, &east_},
                                        std::pair{y_.least, &south_}, std::pair{y_.most, &north_}}) {
    if (decimals_ && !decimals_->read(value, *multiple)) decimals_.reset();
  }
  return {};
}

void LatticeFinder::read(const PointSet& points) {
  if (!decimals_) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int64_t u = 0, v = 0;
    if (!decimals_->read(points.x[i], u) || !decimals_->read(points.y[i], v)) return decimals_.reset();
    const Point p{static_cast<std::int32_t>(u - west_), static_cast<std::int32_t>(north_ - v)};
    if (common_ == 0 || p.x % common_ != 0 || p.y % common_ != 0) common_ = std::gcd(common_, std::gcd(p.x, p.y));
  }
}

std::optional<FoundLattice> LatticeFinder::find_decimal(PointSteps steps) const {
  if (!decimals_ || steps == PointSteps::kFloat32) return std::nullopt;
  FoundLattice found;
  found.decimals_ = decimals_;
  found.west_ = west_;
  found.north_ = north_;
  found.common_ = common_ == 0 ? 1 : common_;
  const auto multiple = static_cast<double>(found.common_);
  PointLattice& lattice = found.lattice_;
  lattice = {decimals_->digits >= 0 ? multiple / decimals_->power : multiple * decimals_->power,
             static_cast<std::int32_t>((east_ - west_) / found.common_) + 1,
             static_cast<std::int32_t>((north_ - south_) / found.common_) + 1};
  if (steps != PointSteps::kFit) return found;
  // Fitting does not change triangles with more steps.
  constexpr std::int32_t kMostFitSteps = 1 << 24, kEnough = 1 << 23;
  if (std::max(lattice.cols, lattice.rows) > kMostFitSteps) return std::nullopt;
  // Divides the steps of a coarse lattice by a power of two.
  while (std::int64_t{2} * found.factor_ * std::max(lattice.cols, lattice.rows) <= kEnough) found.factor_ *= 2;
  lattice.step /= found.factor_;
  lattice.cols = (lattice.cols - 1) * found.factor_ + 1;
  lattice.rows = (lattice.rows - 1) * found.factor_ + 1;
  return found;
}

FoundLattice LatticeFinder::find_power_of_two(PointSteps steps) const {
  const double size = std::max(x_.size(), y_.size());
  const int bits = steps == PointSteps::kFinest ? 30 : steps == PointSteps::kJudge ? 24 : 23;
  FoundLattice found;
  found.exponent_ = size > 0 ? std::ilogb(size) - bits : 0;
  while (std::ldexp(size, -found.exponent_) > kMaxCoordinate) ++found.exponent_;
  found.lattice_ = {std::ldexp(1.0, found.exponent_), found.whole(x_.size()) + 1, found.whole(y_.size()) + 1};
  return found;
}

FoundLattice LatticeFinder::find(PointSteps steps) const {
  std::optional<FoundLattice> decimal = find_decimal(steps);
  FoundLattice found = decimal ? *decimal : find_power_of_two(steps);
  found.lattice_.west = x_.least;
  found.lattice_.north = y_.most;
  found.steps_ = steps;
  found.extent_ = std::max(x_.size(), y_.size());
  return found;
}

}  // namespace scarp::grid
