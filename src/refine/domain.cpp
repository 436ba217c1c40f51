#include "refine/domain.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace scarp::refine {

namespace {

tin::Vertex insert_point(tin::Triangulation& tin, Point p) { return tin.insert(p, tin.locate(p, tin.last_touched())); }

/// False if two edges cross.
bool constrain_outline(tin::Triangulation& tin, const grid::Outline& outline) {
  for (const auto& polygon : outline) {
    for (Point p : polygon) insert_point(tin, p);
  }
  for (const auto& polygon : outline) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const tin::Vertex a = insert_point(tin, polygon[i]), b = insert_point(tin, polygon[(i + 1) % polygon.size()]);
      if (!tin.constrain(a, b)) return false;
    }
  }
  return true;
}

grid::Outline loosen_outline(const grid::Raster& raster, const grid::Outline& outline, double tolerance) {
  return grid::simplify_outline(raster, grid::close_voids(raster, outline, tolerance), tolerance);
}

/// The constrained edge from v towards `to`, which chains of constrained edges join.
tin::HalfEdge edge_towards(const tin::Triangulation& tin, tin::Vertex v, Point to, std::vector<tin::Triangle>& star) {
  tin.star(v, star);
  const Point from = tin.point(v);
  for (tin::Triangle t : star) {
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const Point p = tin.point(tin.origin(tin::Triangulation::next(h)));
      const bool is_ahead =
          std::int64_t{p.x - from.x} * (to.x - from.x) + std::int64_t{p.y - from.y} * (to.y - from.y) > 0;
      if (tin.origin(h) == v && is_ahead && orient(from, to, p) == 0) return h;
    }
  }
  return tin::kNone;
}

/// Marks a triangle as outside if every path from it to the left side of an outline's edge crosses a constrained edge.
/// Samples cannot decide this: a simplified outline may enclose triangles that contain only nodata, with samples at
/// their corners.
Result<void> mark_outside(tin::Triangulation& tin, const grid::Outline& outline) {
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) tin.set_outside(t, true);
  std::vector<tin::Triangle> stack, star;
  const auto add = [&](tin::Triangle t) {
    if (!tin.is_outside(t)) return;
    tin.set_outside(t, false);
    stack.push_back(t);
  };
  for (const auto& polygon : outline) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point end = polygon[(i + 1) % polygon.size()];
      for (tin::Vertex v = insert_point(tin, polygon[i]); tin.point(v) != end;) {
        const tin::HalfEdge h = edge_towards(tin, v, end, star);
        if (h == tin::kNone) return fail(ErrorKind::kInternal, "an edge of the outline of the valid data is missing");
        add(tin::Triangulation::triangle_of(h));
        v = tin.origin(tin::Triangulation::next(h));
      }
    }
  }
  while (!stack.empty()) {
    const tin::Triangle t = stack.back();
    stack.pop_back();
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const tin::HalfEdge g = tin.twin(h);
      if (g != tin::kNone && !tin.is_constrained(h)) add(tin::Triangulation::triangle_of(g));
    }
  }
  return {};
}

std::uint32_t count_unused_corners(const tin::Triangulation& tin) {
  std::uint32_t unused = 0;
  std::vector<tin::Triangle> star;
  for (tin::Vertex v = 0; v < 4; ++v) {
    tin.star(v, star);
    bool used = false;
    for (tin::Triangle t : star) used = used || !tin.is_outside(t);
    unused += !used;
  }
  return unused;
}

}  // namespace

void follow_curved_border(const grid::Raster& raster, tin::Triangulation& tin, const Frame& frame) {
  constexpr double kStray = 1.0 / 512;
  struct Segment {
    Point a, b;
  };
  std::vector<Segment> stack;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::HalfEdge g = tin.twin(h);
    if (tin.is_outside(h / 3) || (g != tin::kNone && !tin.is_outside(g / 3))) continue;
    stack.push_back({tin.point(tin.origin(h)), tin.point(tin.origin(tin::Triangulation::next(h)))});
  }
  std::vector<double> xs, ys;
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    const std::int32_t steps = std::gcd(std::abs(b.x - a.x), std::abs(b.y - a.y));
    if (steps < 2) continue;
    const Point unit{(b.x - a.x) / steps, (b.y - a.y) / steps};
    xs.clear();
    ys.clear();
    for (std::int32_t i = 0; i <= steps; ++i) {
      const auto [x, y] = frame.apply_affine(a.x + i * unit.x, a.y + i * unit.y);
      xs.push_back(x);
      ys.push_back(y);
    }
    frame.transform->apply(xs, ys);
    const double dx = xs.back() - xs.front(), dy = ys.back() - ys.front(), length = std::hypot(dx, dy);
    // Only the shift across the chord counts: a shift along the chord moves no sample off the mesh.
    double worst = kStray * length / steps;
    std::int32_t split = 0;
    for (std::int32_t i = 1; i < steps; ++i) {
      const double stray = std::abs(dx * (ys[i] - ys.front()) - dy * (xs[i] - xs.front())) / length;
      // Under an exact outline, all samples are valid.
      const bool is_valid = raster.samples == nullptr || raster.is_valid({a.x + i * unit.x, a.y + i * unit.y});
      if (stray > worst && is_valid) {
        worst = stray;
        split = i;
      }
    }
    if (split == 0) continue;
    const Point p{a.x + split * unit.x, a.y + split * unit.y};
    insert_point(tin, p);
    stack.push_back({a, p});
    stack.push_back({p, b});
  }
}

Result<DomainMesh> build_domain(const grid::Raster& raster, double outline_tolerance, const Frame& frame) {
  DomainMesh domain{tin::Triangulation(raster.cols, raster.rows)};
  domain.whole = grid::is_whole(raster);
  if (!domain.whole) {
    grid::Outline outline = grid::trace_outline(raster);
    if (outline.empty())
      return fail(
          ErrorKind::kInput,
          "the raster has no grid cell with three valid corners, so there is no surface to simplify; check nodata");
    grid::Outline simplified;
    if (outline_tolerance > 0) simplified = loosen_outline(raster, outline, outline_tolerance);
    if (!simplified.empty() && constrain_outline(domain.tin, simplified)) {
      outline = std::move(simplified);
    } else {
      domain.tin = tin::Triangulation(raster.cols, raster.rows);
      if (!constrain_outline(domain.tin, outline))
        return fail(ErrorKind::kInternal, "two edges of the outline of the valid data cross");
    }
    SCARP_RETURN_IF_ERROR(mark_outside(domain.tin, outline));
  }
  if (frame.transform) follow_curved_border(raster, domain.tin, frame);
  domain.unused = count_unused_corners(domain.tin);
  return domain;
}

}  // namespace scarp::refine
