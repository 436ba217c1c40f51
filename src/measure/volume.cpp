// The volume between two surfaces of triangles.
//
// Above the intersection of two triangles, the difference of their heights is linear. The intersection is a convex
// polygon: the smaller triangle, clipped by the three sides of the larger one (Sutherland and Hodgman 1974). A fan of
// triangles covers the polygon. The integrals of the positive and of the negative part of a linear function over a
// triangle are formulas in its values at the corners. So the result has no sampling error or tolerance, only the
// rounding of doubles.
//
// Most near pairs of triangles of one surface have only a side in common. Exact signs decide whether a side separates
// two triangles, so that such a pair adds exactly 0, and the volumes of a surface against itself are exactly 0. Pairs
// are found by a tree of boxes. Each triangle of the surface with more triangles is processed separately. Sums are in
// the order of triangles, in parts of fixed size, for any number of threads.
#include "measure/volume.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/box_tree.h"
#include "base/caught.h"
#include "base/function_ref.h"
#include "base/parallel.h"
#include "measure/check_mesh.h"
#include "measure/error_summary.h"
#include "measure/progress_gate.h"
#include "measure/topology.h"
#include "mesh/exact_orient.h"
#include "scarp/measure.h"

namespace scarp::judge {
namespace {

/// A corner of a part of a triangle. At first, z is the height of the triangle's plane; later, a difference of heights.
struct Corner {
  double x = 0, y = 0, z = 0;
  int of = -1;  ///< index of the same corner of the triangle; −1: a new corner
};

/// A triangle that lines have clipped. Three lines turn 3 corners into at most 9, however signs are rounded.
struct Part {
  std::array<Corner, 12> corners;
  std::size_t count = 0;

  void add(const Corner& corner) { corners[count++] = corner; }
};

/// The position of one triangle's corners relative to another's sides: signs[k][i] is for corner i and the side
/// opposite to corner k; 1 is inside.
using Signs = std::array<std::array<int, 3>, 3>;

mesh::Point2 corner(const PlanTriangle& plan, std::size_t k) { return {plan.x[k], plan.y[k]}; }

/// None if `b` lies entirely beyond or on a side of `a`.
std::optional<Signs> find_signs(const PlanTriangle& a, const PlanTriangle& b) {
  Signs signs;
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::Point2 begin = corner(a, (k + 1) % 3), end = corner(a, (k + 2) % 3);
    bool is_inside = false;
    for (std::size_t i = 0; i < 3; ++i) {
      signs[k][i] = mesh::exact_orient(begin, end, corner(b, i));
      is_inside = is_inside || signs[k][i] > 0;
    }
    if (!is_inside) return std::nullopt;
  }
  return signs;
}

/// The distance of a corner from a side, times the side's length: positive inside; corners of the triangle itself have
/// the exact sign.
double distance_from(const PlanTriangle& by, int side, const Corner& at, const Signs& signs) {
  const double rounded = by.weight(side, at.x, at.y);
  if (at.of < 0) return rounded;
  const int sign = signs[static_cast<std::size_t>(side)][static_cast<std::size_t>(at.of)];
  if (sign == 0) return 0;
  constexpr double kLeast = 1e-300;
  return sign > 0 ? std::max(rounded, kLeast) : std::min(rounded, -kLeast);
}

/// The portion of `part` on the inside of one side of `by`.
Part clip(const Part& part, const PlanTriangle& by, int side, const Signs& signs) {
  Part inner;
  for (std::size_t i = 0; i < part.count; ++i) {
    const Corner& here = part.corners[i];
    const Corner& next = part.corners[i + 1 == part.count ? 0 : i + 1];
    const double from = distance_from(by, side, here, signs), to = distance_from(by, side, next, signs);
    if (from >= 0) inner.add(here);
    if (!((from > 0 && to < 0) || (from < 0 && to > 0))) continue;
    const double t = from / (from - to);
    inner.add({here.x + t * (next.x - here.x), here.y + t * (next.y - here.y), here.z + t * (next.z - here.z), -1});
  }
  return inner;
}

/// The height of a triangle at a place in it. It is between the heights of its corners despite rounding, and exact at
/// corners.
double height_at(const Facet& facet, double x, double y) {
  std::array<double, 3> weights{};
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double weight = std::max(0.0, facet.plan.weight(k, x, y));
    weights[static_cast<std::size_t>(k)] = weight;
    sum += weight;
  }
  if (!(sum > 0)) return facet.z[0];
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) height += weights[k] / sum * facet.z[k];
  return height;
}

/// Adds the integrals of the positive and negative parts of a linear function over a triangle, from its values at the
/// corners.
void add_triangle(double area, double a, double b, double c, Prism& prism) {
  const double all = area * ((a + b + c) / 3);
  if (a >= 0 && b >= 0 && c >= 0) {
    prism.fill += all;
  } else if (a <= 0 && b <= 0 && c <= 0) {
    prism.cut -= all;
  } else {
    // The line on which the function is 0 separates one corner, and cuts off a triangle there.
    const bool is_up = (a > 0) + (b > 0) + (c > 0) == 1;
    const auto is_alone = [&](double value) { return (value > 0) == is_up; };
    if (is_alone(b)) std::swap(a, b);
    if (is_alone(c)) std::swap(a, c);
    const double alone = area * (a / 3) * (a / (a - b)) * (a / (a - c)), rest = all - alone;
    prism.fill += std::max(0.0, is_up ? alone : rest);
    prism.cut += std::max(0.0, is_up ? -rest : -alone);
  }
}

/// The integrals over a part with differences as z.
Prism integrate(const Part& part) {
  Prism prism;
  const Corner& first = part.corners[0];
  for (std::size_t i = 2; i < part.count; ++i) {
    const Corner &a = part.corners[i - 1], &b = part.corners[i];
    const double area = ((a.x - first.x) * (b.y - first.y) - (a.y - first.y) * (b.x - first.x)) / 2;
    if (!(area > 0)) continue;
    prism.area += area;
    add_triangle(area, first.z, a.z, b.z, prism);
  }
  return prism;
}

Part whole(const Facet& facet) {
  Part part;
  for (std::size_t k = 0; k < 3; ++k) part.add({facet.plan.x[k], facet.plan.y[k], facet.z[k], static_cast<int>(k)});
  return part;
}

}  // namespace

Prism find_prism(const Facet& from, const Facet& to) {
  const auto of_from = find_signs(from.plan, to.plan);
  const auto of_to = of_from ? find_signs(to.plan, from.plan) : std::nullopt;
  if (!of_to) return {};
  // Clips the smaller triangle, so that no corner is computed from a place far outside.
  const bool is_from_small = from.plan.double_area() <= to.plan.double_area();
  const Facet &small = is_from_small ? from : to, &large = is_from_small ? to : from;
  const Signs& signs = is_from_small ? *of_to : *of_from;
  Part part = whole(small);
  for (int side = 0; side < 3 && part.count > 2; ++side) part = clip(part, large.plan, side, signs);
  for (std::size_t i = 0; i < part.count; ++i) {
    Corner& at = part.corners[i];
    const double of_large = height_at(large, at.x, at.y);
    at.z = is_from_small ? of_large - at.z : at.z - of_large;
  }
  return integrate(part);
}

Prism find_prism(const Facet& from, double level) {
  Part part = whole(from);
  for (std::size_t i = 0; i < part.count; ++i) part.corners[i].z = level - part.corners[i].z;
  return integrate(part);
}

}  // namespace scarp::judge

namespace scarp {

namespace {

using judge::Facet;
using judge::PlanTriangle;
using judge::Prism;
using judge::ProgressGate;
using judge::Sum;

tl::unexpected<Error> stopped() { return fail(ErrorKind::kCancelled, "measuring the volume was cancelled"); }

mesh::Point2 place_of(const Mesh& mesh, std::size_t triangle, std::size_t corner) {
  const double* const at = &mesh.positions[3 * std::size_t{mesh.triangles[3 * triangle + corner]}];
  return {at[0], at[1]};
}

/// True if a triangle without area seen from above has an area in space: it is vertical.
bool is_upright(const Mesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t corner, std::size_t axis) {
    return mesh.positions[3 * std::size_t{mesh.triangles[3 * triangle + corner]} + axis];
  };
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const double u = at(1, axis) - at(0, axis), v = at(2, axis) - at(0, axis);
    const double left = u * (at(2, 2) - at(0, 2)), right = v * (at(1, 2) - at(0, 2));
    if (std::abs(left - right) > 1e-9 * (std::abs(left) + std::abs(right))) return true;
  }
  return false;
}

/// Checks that the mesh has one height above each place that it covers, up to rounding. `name`: first or second.
Result<void> check_surface(const Mesh& mesh, const std::string& name, const Run& run, ProgressGate& gate) {
  if (Result<void> usable = judge::check_mesh(mesh); !usable) {
    std::string& message = usable.error().message;
    message.replace(message.find("the mesh"), 8, name);
    return usable;
  }
  bool has_area = true;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const int facing = mesh::exact_orient(place_of(mesh, t, 0), place_of(mesh, t, 1), place_of(mesh, t, 2));
    if (facing > 0) continue;
    has_area = false;
    if (facing == 0 && !is_upright(mesh, t)) continue;
    if (judge::connect(mesh, false).edges.open.empty())
      return fail(ErrorKind::kInput,
                  name + " is a closed solid, and volumes lie between open surfaces: give the one it was made from");
    return fail(ErrorKind::kInput,
                fmt::format("{} has a triangle, number {}, that {}, and volumes lie between surfaces with one height "
                            "above each place: remove it",
                            name, t, facing == 0 ? "stands upright" : "faces down"));
  }
  if (judge::connect(mesh, has_area).is_single_layer) return {};
  std::vector<std::uint32_t> ids(mesh.triangle_count());
  std::iota(ids.begin(), ids.end(), 0);
  bool is_stopped = false;
  const std::uint64_t pairs = judge::count_overlaps(mesh, ids, run.threads, [&](double fraction) {
    is_stopped = !gate.go_on("topology", fraction);
    return !is_stopped;
  });
  if (is_stopped) return stopped();
  if (pairs == 0) return {};
  return fail(ErrorKind::kInput,
              fmt::format("{} has {} of triangles that overlap seen from above, and volumes lie between surfaces with "
                          "one height above each place: remove one of each",
                          name, pairs == 1 ? "1 pair" : fmt::format("{} pairs", pairs)));
}

/// A mesh in coordinates around an origin.
class PlacedMesh {
 public:
  PlacedMesh(const Mesh& mesh, const std::array<double, 3>& origin)
      : mesh_(mesh), shift_{mesh.origin[0] - origin[0], mesh.origin[1] - origin[1], mesh.origin[2] - origin[2]} {}

  std::size_t triangle_count() const { return mesh_.triangle_count(); }
  /// False if the triangle has no area. Rounding may turn a very thin triangle over; then none of its pairs counts.
  bool get(std::size_t triangle, Facet& facet) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh_.triangles[3 * triangle + k];
      facet.plan.x[k] = shift_[0] + mesh_.positions[3 * v];
      facet.plan.y[k] = shift_[1] + mesh_.positions[3 * v + 1];
      facet.z[k] = shift_[2] + mesh_.positions[3 * v + 2];
    }
    return judge::make_counter_clockwise(facet);
  }
  double area() const {
    Sum sum;
    Facet facet;
    for (std::size_t t = 0; t < triangle_count(); ++t) {
      if (get(t, facet)) sum.add(facet.plan.double_area() / 2);
    }
    return sum.value();
  }

 private:
  const Mesh& mesh_;
  std::array<double, 3> shift_;
};

/// The triangles of a mesh by place.
class TriangleFinder {
 public:
  explicit TriangleFinder(const PlacedMesh& mesh) : left_(INFINITY), bottom_(INFINITY), tree_(build(mesh)) {}

  /// Calls visit(triangle) for all triangles whose boxes meet the box of `plan`, in an order that depends on nothing
  /// else.
  template <class Visit>
  void visit(const PlanTriangle& plan, const Visit& visit) const {
    const Box box = box_of(plan);
    tree_.visit([&](const Box& other) { return overlaps(box, other); }, visit);
  }

 private:
  static constexpr double kSteps = 1 << 24;

  std::vector<Box> build(const PlacedMesh& mesh) {
    double right = -INFINITY, top = -INFINITY;
    std::vector<PlanTriangle> plans(mesh.triangle_count());
    Facet facet;
    for (std::size_t t = 0; t < plans.size(); ++t) {
      mesh.get(t, facet);
      plans[t] = facet.plan;
      left_ = std::min(left_, facet.plan.x_extent().lo), right = std::max(right, facet.plan.x_extent().hi);
      bottom_ = std::min(bottom_, facet.plan.y_extent().lo), top = std::max(top, facet.plan.y_extent().hi);
    }
    const double side = std::max(right - left_, top - bottom_);
    scale_ = side > 0 ? kSteps / side : 0;
    std::vector<Box> boxes(plans.size());
    for (std::size_t t = 0; t < plans.size(); ++t) boxes[t] = box_of(plans[t]);
    return boxes;
  }
  Box box_of(const PlanTriangle& plan) const {
    const auto step = [&](double at, double least) {
      return static_cast<std::int32_t>(std::clamp((at - least) * scale_, 0.0, kSteps));
    };
    const judge::Interval across = plan.x_extent(), along = plan.y_extent();
    return {step(across.lo, left_), step(along.lo, bottom_), step(across.hi, left_), step(along.hi, bottom_)};
  }

  double left_, bottom_, scale_ = 0;
  BoxTree tree_;
};

struct Sums {
  Sum cut, fill, area;

  void add(const Prism& prism) {
    cut.add(prism.cut);
    fill.add(prism.fill);
    area.add(prism.area);
  }
};

/// Sums up the results of `add` for each triangle. Returns false if the caller stops.
bool sum_up(std::size_t triangles, const Run& run, ProgressGate& gate,
            FunctionRef<void(std::size_t triangle, Sums& sums)> add, Volumes& volumes) {
  constexpr std::size_t kTogether = 256;
  const std::size_t parts = (triangles + kTogether - 1) / kTogether;
  std::vector<Prism> found(parts);
  Sums sums;
  bool goes_on = gate.go_on("measure", 0);
  if (!goes_on) return false;
  parallel_in_order(
      parts, run.threads,
      [&](std::size_t part, std::size_t) {
        Sums of_part;
        for (std::size_t t = part * kTogether; t < std::min(triangles, (part + 1) * kTogether); ++t) add(t, of_part);
        found[part] = {of_part.cut.value(), of_part.fill.value(), of_part.area.value()};
      },
      [&](std::size_t part) {
        sums.add(found[part]);
        goes_on = gate.go_on("measure", static_cast<double>(part + 1) / static_cast<double>(parts));
        return goes_on;
      });
  volumes.cut = sums.cut.value();
  volumes.fill = sums.fill.value();
  volumes.common_area = sums.area.value();
  return goes_on;
}

/// The area of a surface outside the common part; a remainder from rounding counts as 0.
double outside(double area, double common) {
  const double left = area - common;
  return left > 1e-12 * area ? left : 0;
}

/// Decides which mesh is processed first, so that swapped arguments give the same bits.
bool is_led_by(const Mesh& a, const Mesh& b) {
  if (a.triangle_count() != b.triangle_count()) return a.triangle_count() > b.triangle_count();
  return std::tie(a.origin, a.positions, a.triangles) <= std::tie(b.origin, b.positions, b.triangles);
}

}  // namespace

Result<Volumes> measure_volume(const Mesh& from, const Mesh& to, const Run& run) try {
  ProgressGate gate(run.progress);
  SCARP_RETURN_IF_ERROR(check_surface(from, "the first mesh", run, gate));
  SCARP_RETURN_IF_ERROR(check_surface(to, "the second mesh", run, gate));
  const bool is_swapped = !is_led_by(from, to);
  const Mesh& leader = is_swapped ? to : from;
  const PlacedMesh lead(leader, leader.origin), other(is_swapped ? from : to, leader.origin);
  const TriangleFinder finder(other);
  Volumes volumes;
  const bool is_done = sum_up(
      lead.triangle_count(), run, gate,
      [&](std::size_t triangle, Sums& sums) {
        Facet a, b;
        if (!lead.get(triangle, a)) return;
        finder.visit(a.plan, [&](std::uint32_t id) {
          if (other.get(id, b)) sums.add(judge::find_prism(a, b));
        });
      },
      volumes);
  if (!is_done) return stopped();
  volumes.from_outside = outside(lead.area(), volumes.common_area);
  volumes.to_outside = outside(other.area(), volumes.common_area);
  return is_swapped ? volumes.reversed() : volumes;
} catch (...) {
  return caught(ErrorKind::kInput, "measure the volume");
}

Result<Volumes> measure_volume(const Mesh& from, double level, const Run& run) try {
  if (!std::isfinite(level)) return fail(ErrorKind::kUsage, "a level is a finite height");
  ProgressGate gate(run.progress);
  SCARP_RETURN_IF_ERROR(check_surface(from, "the first mesh", run, gate));
  const PlacedMesh lead(from, from.origin);
  Volumes volumes;
  const bool is_done = sum_up(
      lead.triangle_count(), run, gate,
      [&](std::size_t triangle, Sums& sums) {
        Facet facet;
        if (lead.get(triangle, facet)) sums.add(judge::find_prism(facet, level - from.origin[2]));
      },
      volumes);
  if (!is_done) return stopped();
  return volumes;
} catch (...) {
  return caught(ErrorKind::kInput, "measure the volume");
}

}  // namespace scarp
