#include "grid/far_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace scarp::grid {

namespace {

struct Quartiles {
  double lower = 0, upper = 0;

  explicit Quartiles(std::vector<double> values) {
    const auto quarter = [&](std::size_t k) {
      const auto nth = values.begin() + static_cast<std::ptrdiff_t>(k * (values.size() - 1) / 4);
      std::nth_element(values.begin(), nth, values.end());
      return *nth;
    };
    lower = quarter(1);
    upper = quarter(3);
  }
  double range() const { return upper - lower; }
  bool holds(double value, double margin) const { return value >= lower - margin && value <= upper + margin; }
};

/// The larger side of a bounding box.
class Span {
 public:
  void include(double x, double y) {
    west_ = std::min(west_, x);
    east_ = std::max(east_, x);
    south_ = std::min(south_, y);
    north_ = std::max(north_, y);
  }
  double size() const { return std::max(east_ - west_, north_ - south_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double west_ = kInfinity, east_ = -kInfinity, south_ = kInfinity, north_ = -kInfinity;
};

}  // namespace

std::string describe_far_points(const PointSet& points) {
  if (points.size() < 2) return "";
  const Quartiles x(points.x), y(points.y);
  const double margin = 10 * std::max(x.range(), y.range());
  Span all, near;
  std::size_t first = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.include(points.x[i], points.y[i]);
    if (x.holds(points.x[i], margin) && y.holds(points.y[i], margin)) {
      near.include(points.x[i], points.y[i]);
    } else if (count++ == 0) {
      first = i;
    }
  }
  constexpr std::size_t kFew = 3;
  if (count == 0 || count > std::max(kFew, points.size() / 100) || all.size() < 10 * near.size()) return "";
  const std::string name = fmt::format("the point at ({}, {})", points.x[first], points.y[first]);
  if (count == 1)
    return fmt::format("{} lies far from all others, which span {}: remove it if it is an error", name, near.size());
  return fmt::format("{} and {} more lie far from all others, which span {}: remove them if they are errors", name,
                     count - 1, near.size());
}

}  // namespace scarp::grid
