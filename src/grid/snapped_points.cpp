#include "grid/snapped_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/curve.h"
#include "base/radix_sort.h"
#include "base/sort.h"
#include "grid/far_points.h"

namespace scarp::grid {

namespace {

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

struct Snapped {
  PointLattice lattice;
  std::vector<Point> at;  ///< by point
};

/// Nothing if the points do not lie on a decimal lattice.
std::optional<Snapped> snap_to_decimals(const PointSet& points, const AxisExtent& x, const AxisExtent& y) {
  const auto decimals = finest_decimals(x, y);
  if (!decimals) return std::nullopt;
  std::int64_t west = 0, east = 0, south = 0, north = 0;
  for (const auto& [value, multiple] :
       {std::pair{x.least, &west}, std::pair{x.most, &east}, std::pair{y.least, &south}, std::pair{y.most, &north}}) {
    if (!decimals->read(value, *multiple)) return std::nullopt;
  }
  Snapped snapped;
  snapped.at.reserve(points.size());
  std::int32_t common = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int64_t u = 0, v = 0;
    if (!decimals->read(points.x[i], u) || !decimals->read(points.y[i], v)) return std::nullopt;
    const Point p{static_cast<std::int32_t>(u - west), static_cast<std::int32_t>(north - v)};
    if (common == 0 || p.x % common != 0 || p.y % common != 0) common = std::gcd(common, std::gcd(p.x, p.y));
    snapped.at.push_back(p);
  }
  if (common == 0) common = 1;  // all points are at one place
  if (common > 1) {
    for (Point& p : snapped.at) p = {p.x / common, p.y / common};
  }
  const auto multiple = static_cast<double>(common);
  snapped.lattice = {decimals->digits >= 0 ? multiple / decimals->power : multiple * decimals->power,
                     static_cast<std::int32_t>((east - west) / common) + 1,
                     static_cast<std::int32_t>((north - south) / common) + 1};
  return snapped;
}

/// Divides the steps of a coarse lattice by a power of two.
void make_room(Snapped& snapped) {
  constexpr std::int32_t kEnough = 1 << 23;
  PointLattice& lattice = snapped.lattice;
  std::int32_t factor = 1;
  while (std::int64_t{2} * factor * std::max(lattice.cols, lattice.rows) <= kEnough) factor *= 2;
  for (Point& p : snapped.at) p = {p.x * factor, p.y * factor};
  lattice.step /= factor;
  lattice.cols = (lattice.cols - 1) * factor + 1;
  lattice.rows = (lattice.rows - 1) * factor + 1;
}

Snapped snap_to_power_of_two(const PointSet& points, const AxisExtent& x, const AxisExtent& y, PointSteps steps) {
  const double size = std::max(x.size(), y.size());
  const int bits = steps == PointSteps::kFinest ? 30 : steps == PointSteps::kJudge ? 24 : 23;
  int exponent = size > 0 ? std::ilogb(size) - bits : 0;
  while (std::ldexp(size, -exponent) > kMaxCoordinate) ++exponent;
  const auto whole = [exponent](double length) {
    return static_cast<std::int32_t>(std::nearbyint(std::ldexp(length, -exponent)));
  };
  Snapped snapped{{std::ldexp(1.0, exponent), whole(x.size()) + 1, whole(y.size()) + 1}, {}};
  snapped.at.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    snapped.at.push_back({whole(points.x[i] - x.least), whole(y.most - points.y[i])});
  return snapped;
}

struct Keyed {
  std::uint64_t key;
  std::uint32_t point;
};

/// The point that represents its place, and the height there.
struct Chosen {
  std::uint32_t point;
  double height;
};

/// Chooses among points in input order. REQUIRES: at least one point.
Chosen choose(const PointSet& points, DuplicatePolicy policy, std::span<const Keyed> among) {
  const auto height = [&](const Keyed& k) { return points.z[k.point]; };
  const auto lower = [&](const Keyed& a, const Keyed& b) { return height(a) < height(b); };
  const Keyed& first = among.front();
  const Keyed* chosen = &first;
  switch (policy) {
    case DuplicatePolicy::kFirst:
      break;
    case DuplicatePolicy::kLast:
      chosen = &among.back();
      break;
    case DuplicatePolicy::kHighest:
      chosen = &*std::max_element(among.begin(), among.end(), lower);
      break;
    case DuplicatePolicy::kLowest:
      chosen = &*std::min_element(among.begin(), among.end(), lower);
      break;
    case DuplicatePolicy::kMean: {
      // A sum of differences from the first height does not overflow where a sum of heights would, and does not change
      // equal heights.
      double sum = 0;
      for (const Keyed& k : among) sum += (height(k) - height(first)) / static_cast<double>(among.size());
      return {first.point, height(first) + sum};
    }
  }
  return {chosen->point, height(*chosen)};
}

bool are_at_one_place(const PointSet& points, std::uint32_t a, std::uint32_t b) {
  return points.x[a] == points.x[b] && points.y[a] == points.y[b];
}

/// Sorts by place, and by input order at each place.
void sort_by_place(const PointSet& points, std::span<Keyed> among) {
  sort_rarely(among, [&](const Keyed& a, const Keyed& b) {
    const auto place = [&](const Keyed& k) { return std::tuple(points.x[k.point], points.y[k.point], k.point); };
    return place(a) < place(b);
  });
}

/// Stores the choice at each place in `chosen`, and returns the index of the choice at the place of `best`. `among`:
/// sorted by place.
std::size_t choose_places(const PointSet& points, DuplicatePolicy policy, std::span<const Keyed> among,
                          const Chosen& best, std::vector<Chosen>& chosen) {
  chosen.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < among.size(); i = end) {
    while (end < among.size() && are_at_one_place(points, among[end].point, among[i].point)) ++end;
    if (are_at_one_place(points, best.point, among[i].point)) kept = chosen.size();
    chosen.push_back(choose(points, policy, among.subspan(i, end - i)));
  }
  return kept;
}

/// True for points too near for the finest lattice.
bool are_inseparable(const PointSet& points, std::uint32_t a, std::uint32_t b, double extent) {
  return std::max(std::abs(points.x[a] - points.x[b]), std::abs(points.y[a] - points.y[b])) < extent * 0x1p-30;
}

bool are_all_at_one_place(const PointSet& points, std::span<const Keyed> among) {
  return std::all_of(among.begin(), among.end(),
                     [&](const Keyed& k) { return are_at_one_place(points, k.point, among.front().point); });
}

tl::unexpected<Error> refuse_to_merge(const PointSet& points, std::uint32_t a, std::uint32_t b, double extent) {
  const std::string far = describe_far_points(points);
  return fail(ErrorKind::kInput,
              fmt::format("the points at ({}, {}) and ({}, {}) cannot be told apart on a "
                          "lattice of 2^30 steps over the extent of {}; {}",
                          points.x[a], points.y[a], points.x[b], points.y[b], extent,
                          far.empty() ? "split the points into smaller areas, or remove one of the two"
                                      : far + ", else split the points into smaller areas"));
}

Result<void> check(const PointSet& points) {
  if (points.x.size() != points.y.size() || points.x.size() != points.z.size())
    return fail(ErrorKind::kUsage, fmt::format("the points have {} x, {} y and {} z: give one of each for every point",
                                               points.x.size(), points.y.size(), points.z.size()));
  if (points.size() == 0) return fail(ErrorKind::kInput, "there are no points");
  if (points.size() > std::numeric_limits<std::int32_t>::max())
    return fail(ErrorKind::kInput,
                fmt::format("there are {} points; Scarp holds up to 2,147,483,647: thin them out", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points.x[i]) || !std::isfinite(points.y[i]) || !std::isfinite(points.z[i]))
      return fail(ErrorKind::kInput, fmt::format("point {} (counted from 0) has a coordinate that is not finite", i));
  }
  for (const PointLine& line : points.lines) {
    if (std::any_of(line.points.begin(), line.points.end(), [&](std::uint32_t p) { return p >= points.size(); }))
      return fail(ErrorKind::kUsage, line.name + " has a point that the set has not");
  }
  for (const auto& ring : points.boundary) {
    if (std::any_of(ring.begin(), ring.end(), [&](std::uint32_t p) { return p >= points.size(); }))
      return fail(ErrorKind::kUsage, "the boundary has a point that the set has not");
  }
  return {};
}

}  // namespace

std::uint32_t find_point(const SnappedPoints& points, Point at) {
  const auto place = [](Point p) {
    return curve_place(static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y));
  };
  const auto found =
      std::partition_point(points.at.begin(), points.at.end(), [&](Point p) { return place(p) < place(at); });
  return found != points.at.end() && *found == at ? static_cast<std::uint32_t>(found - points.at.begin())
                                                  : static_cast<std::uint32_t>(points.size());
}

Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy, PointSteps steps) {
  SCARP_RETURN_IF_ERROR(check(points));
  AxisExtent x, y, z;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x.include(points.x[i]);
    y.include(points.y[i]);
    z.include(points.z[i]);
  }
  constexpr double kReach = 1e100;  // the limit of the arithmetic of planes
  if (std::max({x.reach(), y.reach(), z.reach()}) > kReach)
    return fail(ErrorKind::kInput, "a point has a coordinate beyond 1e100; only smaller ones can be triangulated");
  const double extent = std::max(x.size(), y.size());
  if (extent > 0 && extent < 1 / kReach)
    return fail(ErrorKind::kInput,
                fmt::format("all points lie within {} of each other; only a larger extent than 1e-100 can be "
                            "triangulated: give x and y in a smaller unit",
                            extent));
  SnappedPoints result;
  Snapped snapped;
  std::optional<Snapped> decimal;
  if (steps != PointSteps::kFloat32) decimal = snap_to_decimals(points, x, y);
  // Fitting does not change triangles with more steps.
  constexpr std::int32_t kMostFitSteps = 1 << 24;
  if (decimal && steps == PointSteps::kFit && std::max(decimal->lattice.cols, decimal->lattice.rows) > kMostFitSteps)
    decimal.reset();
  if (decimal && steps == PointSteps::kFit) make_room(*decimal);
  result.is_exact = decimal.has_value();
  snapped = decimal ? std::move(*decimal) : snap_to_power_of_two(points, x, y, steps);

  std::vector<Keyed> keys;
  keys.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    keys.push_back(
        {curve_place(static_cast<std::uint64_t>(snapped.at[i].x), static_cast<std::uint64_t>(snapped.at[i].y)), i});
  snapped.at = {};
  radix_sort(keys, [](const Keyed& k) { return k.key; });
  std::vector<Chosen> places;
  result.at.reserve(keys.size());
  result.source.reserve(keys.size());
  result.z.reserve(keys.size());
  result.lattice = snapped.lattice;
  result.lattice.west = x.least;
  result.lattice.north = y.most;
  const bool has_lines = !points.lines.empty() || !points.boundary.empty(),
             has_echoes = has_lines || steps != PointSteps::kFinest;
  if (has_echoes) result.place.resize(points.size());
  for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
    while (end < keys.size() && keys[end].key == keys[i].key) ++end;
    const std::span<Keyed> here(keys.data() + i, end - i);
    places.assign(1, choose(points, policy, here));
    std::size_t kept = 0;
    if (!are_all_at_one_place(points, here)) {
      sort_by_place(points, here);
      for (std::size_t k = 1; k < here.size() && !has_lines && steps != PointSteps::kJudge; ++k) {
        const std::uint32_t a = here[k - 1].point, b = here[k].point;
        if (!are_at_one_place(points, a, b) && (!has_echoes || are_inseparable(points, a, b, extent)))
          return refuse_to_merge(points, a, b, extent);
      }
      const Chosen best = places.front();
      kept = choose_places(points, policy, here, best, places);
    }
    for (const Keyed& k : here) {
      if (has_echoes) result.place[k.point] = static_cast<std::uint32_t>(result.size());
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto& [point, height] = places[k];
      if (k != kept) result.echoes.push_back({static_cast<std::uint32_t>(result.size()), point, height});
    }
    const auto& [point, height] = places[kept];
    const std::uint64_t key = here.front().key;
    result.at.push_back(
        {static_cast<std::int32_t>(gather_bits(key)), static_cast<std::int32_t>(gather_bits(key >> 1))});
    result.source.push_back(point);
    result.z.push_back(height);
  }
  result.duplicates = points.size() - result.size() - result.echoes.size();
  return result;
}

}  // namespace scarp::grid
