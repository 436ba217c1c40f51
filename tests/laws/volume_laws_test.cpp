// Volumes against an oracle that clips nothing: it sweeps a line over both surfaces.
//
// The abscissas of interest: a side ends, two sides cross, or the line where two planes meet crosses a side. Between
// two neighbouring ones, the length of the sweeping line in a triangle, and the areas above and below on it, are
// polynomials of degree 2 at most, which Simpson's rule integrates exactly.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "laws/point_sets.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp::volume_laws_test {
namespace {

using Long = long double;

struct Side {
  Long x0, y0, x1, y1;

  bool holds(Long x) const { return x >= std::min(x0, x1) && x <= std::max(x0, x1) && x0 != x1; }
  Long at(Long x) const { return y0 + (x - x0) / (x1 - x0) * (y1 - y0); }
};

/// z = height + x · east + y · north.
struct Plane {
  Long height, east, north;
};

struct Triangle {
  std::array<Side, 3> sides;
  Plane plane;
};

struct Sheet {
  std::vector<Triangle> triangles;

  Sheet(const Mesh& mesh, const std::array<double, 3>& origin) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      std::array<Long, 3> x, y, z;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = mesh.triangles[3 * t + k];
        x[k] = Long{mesh.origin[0]} - origin[0] + mesh.positions[3 * v];
        y[k] = Long{mesh.origin[1]} - origin[1] + mesh.positions[3 * v + 1];
        z[k] = Long{mesh.origin[2]} - origin[2] + mesh.positions[3 * v + 2];
      }
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) triangle.sides[k] = {x[k], y[k], x[(k + 1) % 3], y[(k + 1) % 3]};
      const Long ux = x[1] - x[0], uy = y[1] - y[0], uz = z[1] - z[0], vx = x[2] - x[0], vy = y[2] - y[0],
                 vz = z[2] - z[0], area = ux * vy - uy * vx;
      const Long east = (uz * vy - uy * vz) / area, north = (ux * vz - uz * vx) / area;
      triangle.plane = {z[0] - east * x[0] - north * y[0], east, north};
      triangles.push_back(triangle);
    }
  }
};

struct Sweep {
  Long cut = 0, fill = 0, area = 0;
};

std::optional<std::array<Long, 2>> section(const Triangle& triangle, Long x) {
  Long low = HUGE_VALL, high = -HUGE_VALL;
  for (const Side& side : triangle.sides) {
    if (!side.holds(x)) continue;
    low = std::min(low, side.at(x)), high = std::max(high, side.at(x));
  }
  if (!(low < high)) return std::nullopt;
  return std::array{low, high};
}

/// On the line at x.
Sweep sweep_at(const Sheet& from, const Sheet& to, Long x) {
  Sweep sums;
  for (const Triangle& a : from.triangles) {
    const auto in_a = section(a, x);
    if (!in_a) continue;
    for (const Triangle& b : to.triangles) {
      const auto in_b = section(b, x);
      if (!in_b) continue;
      const Long low = std::max((*in_a)[0], (*in_b)[0]), high = std::min((*in_a)[1], (*in_b)[1]);
      if (!(low < high)) continue;
      const auto rise = [&](Long y) {
        return b.plane.height - a.plane.height + x * (b.plane.east - a.plane.east) +
               y * (b.plane.north - a.plane.north);
      };
      const Long at_low = rise(low), at_high = rise(high), length = high - low;
      sums.area += length;
      const auto add = [&](Long mean, Long part) { (mean > 0 ? sums.fill : sums.cut) += std::abs(mean) * part; };
      if ((at_low > 0) == (at_high > 0) || at_low == 0 || at_high == 0) {
        add((at_low + at_high) / 2, length);
      } else {
        const Long share = at_low / (at_low - at_high);
        add(at_low / 2, share * length);
        add(at_high / 2, (1 - share) * length);
      }
    }
  }
  return sums;
}

void add_crossing(const Side& a, const Side& b, std::vector<Long>& abscissas) {
  const Long ux = a.x1 - a.x0, uy = a.y1 - a.y0, vx = b.x1 - b.x0, vy = b.y1 - b.y0, cross = ux * vy - uy * vx;
  if (cross == 0) return;
  const Long t = ((b.x0 - a.x0) * vy - (b.y0 - a.y0) * vx) / cross,
             s = ((b.x0 - a.x0) * uy - (b.y0 - a.y0) * ux) / cross;
  if (t >= 0 && t <= 1 && s >= 0 && s <= 1) abscissas.push_back(a.x0 + t * ux);
}

Sweep sweep_over(const Sheet& from, const Sheet& to) {
  std::vector<Long> abscissas;
  for (const Sheet* sheet : {&from, &to}) {
    for (const Triangle& triangle : sheet->triangles) {
      for (const Side& side : triangle.sides) abscissas.push_back(side.x0);
    }
  }
  for (const Triangle& a : from.triangles) {
    for (const Triangle& b : to.triangles) {
      for (const Side& one : a.sides) {
        for (const Side& other : b.sides) add_crossing(one, other, abscissas);
      }
      const auto rise = [&](Long x, Long y) {
        return b.plane.height - a.plane.height + x * (b.plane.east - a.plane.east) +
               y * (b.plane.north - a.plane.north);
      };
      for (const Triangle* of : {&a, &b}) {
        for (const Side& side : of->sides) {
          const Long begin = rise(side.x0, side.y0), end = rise(side.x1, side.y1);
          if ((begin > 0) != (end > 0)) abscissas.push_back(side.x0 + begin / (begin - end) * (side.x1 - side.x0));
        }
      }
    }
  }
  std::sort(abscissas.begin(), abscissas.end());
  Sweep sums;
  for (std::size_t k = 0; k + 1 < abscissas.size(); ++k) {
    const Long left = abscissas[k], width = abscissas[k + 1] - left;
    if (!(width > 0)) continue;
    // Gauss' two points lie inside, where no section is ambiguous, and are exact for degree 3.
    const Long off = width / 2 * (1 - 1 / std::sqrt(3.0L));
    for (const Long x : {left + off, left + width - off}) {
      const Sweep at = sweep_at(from, to, x);
      sums.cut += at.cut * width / 2;
      sums.fill += at.fill * width / 2;
      sums.area += at.area * width / 2;
    }
  }
  return sums;
}

/// A triangulation of random points; none if they have none.
std::optional<Mesh> any_sheet(testing::Scatter scatter) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const int count = 3 + static_cast<int>(seed % 23);
  const auto heights = *rc::gen::element(testing::Heights::kReal, testing::Heights::kSteps);
  auto made = simplify_points(testing::random_points(seed, count, scatter, heights),
                              {.max_error = 0.0, .float32_positions = false});
  if (!made || made->simplified.mesh.triangles.empty()) return std::nullopt;
  return std::move(made->simplified.mesh);
}

RC_GTEST_PROP(volume, is_that_of_a_line_that_sweeps_over_both, ()) {
  const testing::Scatter scatter =
      *rc::gen::elementOf(std::vector(std::begin(testing::kScatters), std::end(testing::kScatters)));
  const auto from = any_sheet(scatter), to = any_sheet(scatter);
  RC_PRE(from.has_value() && to.has_value());
  const auto volumes = measure_volume(*from, *to);
  if (!volumes) RC_FAIL(volumes.error().message);
  const Sheet before(*from, from->origin), after(*to, from->origin);
  const Sweep sweep = sweep_over(before, after);
  const double area = std::max(measure_volume(*from, 0)->common_area, measure_volume(*to, 0)->common_area);
  const double most = 1e-11 * 100 * area;
  RC_ASSERT(std::abs(volumes->common_area - static_cast<double>(sweep.area)) <= 1e-11 * area);
  RC_ASSERT(std::abs(volumes->cut - static_cast<double>(sweep.cut)) <= most);
  RC_ASSERT(std::abs(volumes->fill - static_cast<double>(sweep.fill)) <= most);
  RC_ASSERT(std::abs(volumes->net() - static_cast<double>(sweep.cut - sweep.fill)) <= most);
  RC_ASSERT(volumes->cut >= 0 && volumes->fill >= 0);

  const Volumes back = *measure_volume(*to, *from, {.threads = 4}), again = volumes->reversed();
  RC_ASSERT(std::memcmp(&back, &again, sizeof back) == 0);
  const Volumes self = *measure_volume(*from, *from);
  RC_ASSERT(self.cut == 0 && self.fill == 0 && self.from_outside == 0 && self.to_outside == 0);
}

}  // namespace
}  // namespace scarp::volume_laws_test
