// Areas, angles and T-junctions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/array.h"
#include "base/function_ref.h"
#include "base/parallel.h"
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

/// The tangent of the smallest angle; 0 without area.
double smallest_tangent(const PlanTriangle& plan) {
  const double area = std::abs(plan.double_area());
  if (area == 0) return 0;
  std::array<double, 3> sides{};  // squared
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
    const double x = plan.x[b] - plan.x[a], y = plan.y[b] - plan.y[a];
    sides[k] = x * x + y * y;
  }
  const std::size_t k = sides[1] < sides[0] ? (sides[2] < sides[1] ? 2 : 1) : (sides[2] < sides[0] ? 2 : 0);
  const std::size_t a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
  const double dot =
      (plan.x[a] - plan.x[k]) * (plan.x[b] - plan.x[k]) + (plan.y[a] - plan.y[k]) * (plan.y[b] - plan.y[k]);
  return area / dot;
}

double degrees_of(double tangent) { return std::atan(tangent) * (180 / std::numbers::pi); }

constexpr std::size_t kShapesTogether = 1 << 15;

std::size_t part_count(std::size_t count) { return (count + kShapesTogether - 1) / kShapesTogether; }

/// Calls task(part, first, end) for the parts of 0 … count − 1.
void in_parts(std::size_t count, int threads, FunctionRef<void(std::size_t, std::size_t, std::size_t)> task) {
  parallel_for(part_count(count), threads, [&](std::size_t part) {
    task(part, part * kShapesTogether, std::min(count, (part + 1) * kShapesTogether));
  });
}

/// True if the triangle has no area in space, up to the rounding of the cross product.
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

std::uint64_t count_t_junctions(const Mesh& mesh, const Connections& connections) {
  const std::vector<OpenEdge>& open = connections.edges.open;
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
  if (connections.is_single_layer) {
    for (const OpenEdge& edge : open) is_used[edge.from] = true;
  } else {
    for (const std::uint32_t v : mesh.triangles) is_used[connections.vertex(v)] = true;
  }
  std::uint64_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_used[v]) continue;
    const double x = mesh.positions[3 * v], y = mesh.positions[3 * v + 1];
    if (x < box.x0 - reach || x > box.x1 + reach || y < box.y0 - reach || y > box.y1 + reach) continue;
    const auto breaks = [&](std::uint32_t i) {
      const std::uint32_t* corners = &mesh.triangles[3 * std::size_t{open[i].triangle}];
      if (std::any_of(corners, corners + 3, [&](std::uint32_t corner) { return connections.vertex(corner) == v; }))
        return false;
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

void count_faults(const Mesh& mesh, int threads, Measurement& result) {
  struct Faults {
    std::uint64_t down_facing = 0, degenerate = 0;
  };
  std::vector<Faults> found(part_count(mesh.triangle_count()));
  in_parts(mesh.triangle_count(), threads, [&](std::size_t part, std::size_t first, std::size_t end) {
    Faults faults;
    for (std::size_t t = first; t < end; ++t) {
      faults.down_facing += plan_of(mesh, t).double_area() < 0;
      faults.degenerate += is_degenerate(mesh, t);
    }
    found[part] = faults;
  });
  for (const Faults& faults : found) {
    result.down_facing += faults.down_facing;
    result.degenerate += faults.degenerate;
  }
}

void measure_angles(const Mesh& mesh, std::span<const std::uint32_t> judged, int threads, Measurement& result) {
  if (judged.empty()) return;
  Array<double> tangents;
  tangents.resize(judged.size());
  in_parts(judged.size(), threads, [&](std::size_t, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) tangents[i] = smallest_tangent(plan_of(mesh, judged[i]));
  });
  // From the largest percentile down, so that each search needs only the values below the previous one.
  constexpr std::array<std::size_t, 3> kPercents{1, 5, 50};
  double* end = tangents.end();
  for (std::size_t i = kPercents.size(); i-- > 0;) {
    double* at = tangents.begin() + std::max<std::size_t>(1, (tangents.size() * kPercents[i] + 99) / 100) - 1;
    if (at < end) std::nth_element(tangents.begin(), at, end);
    result.angle_percentiles[i] = degrees_of(*at);
    end = at;
  }
  result.min_angle =
      end == tangents.begin() ? result.angle_percentiles[0] : degrees_of(*std::min_element(tangents.begin(), end));
}

}  // namespace scarp::judge
