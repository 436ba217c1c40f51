// The integer lattice of scattered points, found in two passes over the points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/point.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// The lattice on which points are distinguished: columns count eastwards, rows southwards, as in a raster.
struct PointLattice {
  double step = 0;  ///< size of a column and of a row, in units of x and y
  std::int32_t cols = 0, rows = 0;
  double west = 0, north = 0;  ///< position of column 0 and row 0
};

/// The resolution of the lattice.
enum class PointSteps {
  kFinest,
  kFloat32,  ///< so coarse that its points have exact float32 offsets from the middle; all vertices then lie on it
  kFit,      ///< leaves space between points for vertices moved by fitting
  kJudge,    ///< any resolution: points are only judged, so no two are too near each other
};

struct AxisExtent {
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double size() const { return most - least; }
  double reach() const { return std::max(std::abs(least), std::abs(most)); }
};

/// Coordinates as whole multiples of a power of ten, 10^-digits.
struct Decimals {
  int digits = 0;
  double power = 1;  ///< 10^|digits|, which a double holds exactly up to 10^22

  /// Sets the nearest multiple. Returns true if the double nearest to this multiple is the coordinate.
  bool read(double value, std::int64_t& multiple) const {
    const double nearest = std::nearbyint(digits >= 0 ? value * power : value / power);
    multiple = static_cast<std::int64_t>(nearest);
    return (digits >= 0 ? nearest / power : nearest * power) == value;
  }
};

/// A lattice, and the place of each point on it.
class FoundLattice {
 public:
  const PointLattice& lattice() const { return lattice_; }
  PointSteps steps() const { return steps_; }
  /// True if the points lie exactly on a decimal lattice.
  bool is_exact() const { return decimals_.has_value(); }
  /// The larger side of the points' extent.
  double extent() const { return extent_; }

  /// The lattice point of one of the points.
  Point place(double x, double y) const {
    if (!decimals_) return {whole(x - lattice_.west), whole(lattice_.north - y)};
    std::int64_t u = 0, v = 0;
    decimals_->read(x, u);
    decimals_->read(y, v);
    return {static_cast<std::int32_t>(u - west_) / common_ * factor_,
            static_cast<std::int32_t>(north_ - v) / common_ * factor_};
  }

 private:
  friend class LatticeFinder;

  std::int32_t whole(double length) const {
    return static_cast<std::int32_t>(std::nearbyint(std::ldexp(length, -exponent_)));
  }

  PointLattice lattice_;
  PointSteps steps_ = PointSteps::kFinest;
  double extent_ = 0;
  std::optional<Decimals> decimals_;
  std::int64_t west_ = 0, north_ = 0;     // multiples
  std::int32_t common_ = 1, factor_ = 1;  // the step is common_ / factor_ multiples
  int exponent_ = 0;                      // without decimals: the step is 2^exponent_
};

/// Calls include() for all points, then check(), then read() for all points.
class LatticeFinder {
 public:
  void include(const PointSet& points);
  /// Fails with kInput for a coordinate or height beyond 1e100, and for an extent below 1e-100.
  Result<void> check();
  void read(const PointSet& points);
  FoundLattice find(PointSteps steps) const;

  const AxisExtent& x() const { return x_; }
  const AxisExtent& y() const { return y_; }

 private:
  std::optional<FoundLattice> find_decimal(PointSteps steps) const;
  FoundLattice find_power_of_two(PointSteps steps) const;

  AxisExtent x_, y_, z_;
  std::optional<Decimals> decimals_;
  std::int64_t west_ = 0, east_ = 0, south_ = 0, north_ = 0;  // multiples
  std::int32_t common_ = 0;                                   // divisor of all distances; 0: all points are at one place
};

}  // namespace scarp::grid
