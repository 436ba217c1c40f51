// Areas, angles and T-junctions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "measure/bucket_grid.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

PlanTriangle plan_of(const Mesh& mesh, std::size_t t) {
  PlanTriangle plan;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t v = mesh.triangles[3 * t + k];
    plan.x[k] = mesh.positions[3 * v];
    plan.y[k] = mesh.positions[3 * v + 1];
  }
  return plan;
}

/// Degrees; 0 without area.
double smallest_angle(const PlanTriangle& plan) {
  const double area = std::abs(plan.double_area());
  if (area == 0) return 0;
  const std::array<double, 3> sides{plan.side(0), plan.side(1), plan.side(2)};
  const int k = static_cast<int>(std::min_element(sides.begin(), sides.end()) - sides.begin());
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  const double dot =
      (plan.x[a] - plan.x[k]) * (plan.x[b] - plan.x[k]) + (plan.y[a] - plan.y[k]) * (plan.y[b] - plan.y[k]);
  return std::atan2(area, dot) * (180 / std::numbers::pi);
}

/// No area in space, up to the rounding of the cross product.
bool is_degenerate(const Mesh& mesh, std::size_t t) {
  const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t]}];
  const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 1]}];
  const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 2]}];
  const std::array<double, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double p = u[i] * v[j], q = u[j] * v[i];
    if (std::abs(p - q) > 4e-16 * (std::abs(p) + std::abs(q))) return false;
  }
  return true;
}

struct PlanSegment {
  double ax = 0, ay = 0, bx = 0, by = 0;
  Interval y_extent() const { return {std::min(ay, by), std::max(ay, by)}; }
  Interval x_range(double lo, double hi) const {
    const PlanTriangle flat{{ax, bx, bx}, {ay, by, by}};
    return flat.x_range(lo, hi);
  }
  double length() const { return std::hypot(bx - ax, by - ay); }
  /// True if p lies within `tolerance` of the segment, but not of its ends.
  bool has_inside(double px, double py, double tolerance) const {
    const double ux = bx - ax, uy = by - ay, size = length();
    if (size <= 2 * tolerance) return false;
    const double along = (ux * (px - ax) + uy * (py - ay)) / size, off = (ux * (py - ay) - uy * (px - ax)) / size;
    return along > tolerance && along < size - tolerance && std::abs(off) <= tolerance;
  }
};

}  // namespace

double position_noise(const Mesh& mesh) {
  double largest = 0;
  bool is_float = true;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double value = mesh.positions[3 * v + k];
      largest = std::max(largest, std::abs(value));
      is_float = is_float && static_cast<double>(static_cast<float>(value)) == value;
    }
  }
  return largest * (is_float ? 0x1p-22 : 0x1p-51);
}

std::uint64_t count_t_junctions(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                std::span<const OpenEdge> open) {
  if (open.empty()) return 0;
  const auto segment = [&](std::size_t i) {
    const double* a = &mesh.positions[3 * std::size_t{open[i].from}];
    const double* b = &mesh.positions[3 * std::size_t{open[i].to}];
    return PlanSegment{a[0], a[1], b[0], b[1]};
  };
  Box box;
  double longest = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const PlanSegment s = segment(i);
    box.include(s.ax, s.ay);
    box.include(s.bx, s.by);
    longest = std::max(longest, s.length());
  }
  const double noise = position_noise(mesh);
  const double reach = noise + 1e-9 * longest;
  BucketGrid grid(box, open.size());
  grid.fill([&](const auto& visit) {
    for (std::size_t i = 0; i < open.size(); ++i) visit(static_cast<std::uint32_t>(i), segment(i));
  });

  std::vector<bool> is_used(mesh.vertex_count());
  for (const std::uint32_t v : mesh.triangles) is_used[welded[v]] = true;
  std::uint64_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_used[v]) continue;
    const double x = mesh.positions[3 * v], y = mesh.positions[3 * v + 1];
    if (x < box.x0 - reach || x > box.x1 + reach || y < box.y0 - reach || y > box.y1 + reach) continue;
    const auto breaks = [&](std::uint32_t i) {
      const std::uint32_t* corners = &mesh.triangles[3 * std::size_t{open[i].triangle}];
      if (std::any_of(corners, corners + 3, [&](std::uint32_t corner) { return welded[corner] == v; })) return false;
      const PlanSegment s = segment(i);
      return s.has_inside(x, y, noise + 1e-9 * s.length());
    };
    bool is_junction = false;
    for (int r = grid.row_of(y - reach); !is_junction && r <= grid.row_of(y + reach); ++r) {
      for (int c = grid.col_of(x - reach); !is_junction && c <= grid.col_of(x + reach); ++c) {
        const auto bucket = grid.bucket(c, r);
        is_junction = std::any_of(bucket.begin(), bucket.end(), breaks);
      }
    }
    count += is_junction;
  }
  return count;
}

void count_faults(const Mesh& mesh, Measurement& result) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    result.down_facing += plan_of(mesh, t).double_area() < 0;
    result.degenerate += is_degenerate(mesh, t);
  }
}

void measure_angles(const Mesh& mesh, std::span<const std::uint32_t> judged, Measurement& result) {
  std::vector<double> angles;
  angles.reserve(judged.size());
  for (const std::uint32_t t : judged) angles.push_back(smallest_angle(plan_of(mesh, t)));
  if (angles.empty()) return;
  const std::array<std::size_t, 3> percents{1, 5, 50};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t rank = std::max<std::size_t>(1, (angles.size() * percents[i] + 99) / 100) - 1;
    std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(rank), angles.end());
    result.angle_percentiles[i] = angles[rank];
  }
  result.min_angle = *std::min_element(angles.begin(), angles.end());
}

}  // namespace scarp::judge
