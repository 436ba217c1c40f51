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
  LatticeFinder finder;
  finder.include(points);
  SCARP_RETURN_IF_ERROR(finder.check());
  if (steps != PointSteps::kFloat32) finder.read(points);
  return snap_points(points, policy, finder.find(steps));
}

Result<SnappedPoints> snap_points(const PointSet& points, DuplicatePolicy policy, const FoundLattice& found) {
  SnappedPoints result;
  result.is_exact = found.is_exact();
  result.lattice = found.lattice();
  const PointSteps steps = found.steps();
  const double extent = found.extent();
  std::vector<Keyed> keys;
  keys.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point at = found.place(points.x[i], points.y[i]);
    keys.push_back({curve_place(static_cast<std::uint64_t>(at.x), static_cast<std::uint64_t>(at.y)), i});
  }
  radix_sort(keys, [](const Keyed& k) { return k.key; });
  std::vector<Chosen> places;
  result.at.reserve(keys.size());
  result.source.reserve(keys.size());
  result.z.reserve(keys.size());
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
