// Meshes to fit, and checks before and after.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "fit/fit.h"
#include "fit/triangle_error.h"
#include "geom/exact_error.h"
#include "laws/fields.h"
#include "laws/mesh_laws.h"
#include "laws/tile_meshes.h"
#include "metric/height_metric.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace scarp::testing {

inline Field any_field() {
  const auto largest = *rc::gen::element(3, 12, 40, 80);
  const auto cols = *rc::gen::inRange(2, largest * 5 / 3), rows = *rc::gen::inRange(2, largest);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const int relief = *rc::gen::inRange(0, 6);
  return relief == 5 ? sloping_field(seed, cols, rows)
                     : random_field(seed, cols, rows, kReliefs[relief], *rc::gen::element(0.0, 0.0, 0.02, 0.1, 0.4));
}

inline double any_threshold() { return *rc::gen::element(0.0, 1e-7, 0.5, 1.0, 2.0, 7.3, 30.0, 1e6); }

/// The greedy mesh; none without a surface.
inline std::optional<tin::Triangulation> refined(const Field& field, double threshold) {
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(field.rows));
  if (!domain) return std::nullopt;
  const metric::HeightMetric metric(field.raster(), threshold);
  refine::Refinement refinement(metric, domain->tin);
  while (!refinement.done()) refinement.insert_worst();
  return std::move(domain->tin);
}

inline fit::FitDepth any_depth(int least_rounds) {
  return {*rc::gen::arbitrary<bool>(),
          *rc::gen::inRange(least_rounds, 4),
          {*rc::gen::inRange(0, 7), *rc::gen::element(1.0, 1.5, 2.5, 4.0), *rc::gen::arbitrary<bool>(),
           *rc::gen::arbitrary<bool>()},
          *rc::gen::inRange(0, 3)};
}

using Points = std::set<std::pair<std::int32_t, std::int32_t>>;

inline Points vertices_of(const tin::Triangulation& tin) {
  Points points;
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) points.insert({tin.point(v).x, tin.point(v).y});
  return points;
}

inline bool is_on_side(Point p, const Field& field) {
  return p.x == 0 || p.y == 0 || p.x == field.cols - 1 || p.y == field.rows - 1;
}

/// Ends of constrained edges within the rectangle.
inline Points outline_of(const tin::Triangulation& tin, const Field& field) {
  Points points;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const Point p = tin.point(tin.origin(h));
    if (tin.is_constrained(h) && !is_on_side(p, field)) points.insert({p.x, p.y});
  }
  return points;
}

inline bool includes(const Points& all, const Points& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// A vertex on the lattice, on samples or anywhere, at the height of the sample next to it.
inline fit::FitCorner any_corner(const Field& field) {
  const int whole = *rc::gen::element(1, grid::kLatticeSteps);
  fit::FitCorner corner;
  corner.x = *rc::gen::inRange(0, (field.cols - 1) * grid::kLatticeSteps / whole + 1) * whole;
  corner.y = *rc::gen::inRange(0, (field.rows - 1) * grid::kLatticeSteps / whole + 1) * whole;
  const float near = field.raster().at({corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps});
  corner.z = std::isnan(near) ? 1.0f : near;
  return corner;
}

/// The first sample that breaks the bound by exact arithmetic, for triangles with corners on the lattice.
inline std::string find_broken_bound(const grid::Raster& raster, const fit::Fitted& fitted, double threshold) {
  for (tin::Triangle t = 0; t < fitted.tin.triangle_count(); ++t) {
    if (fitted.tin.is_outside(t)) continue;
    const std::array<Point, 3> corners = fitted.tin.corners(t);
    std::array<float, 3> heights;
    for (unsigned k = 0; k < 3; ++k) heights[k] = fitted.lattice.heights[fitted.tin.origin(3 * t + k)];
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    for (Point s{left / grid::kLatticeSteps, top / grid::kLatticeSteps}; s.y * grid::kLatticeSteps <= bottom; ++s.y) {
      for (s.x = left / grid::kLatticeSteps; s.x * grid::kLatticeSteps <= right; ++s.x) {
        const Point p{s.x * grid::kLatticeSteps, s.y * grid::kLatticeSteps};
        bool inside = raster.is_valid(s);
        for (unsigned k = 0; k < 3; ++k) inside = inside && orient(corners[k], corners[(k + 1) % 3], p) >= 0;
        if (!inside || is_clearly_kept(corners, heights, p, raster.at(s), threshold)) continue;
        if (geom::exceeds_exactly(corners, heights, p, raster.at(s), threshold))
          return fmt::format("sample ({}, {}) breaks the bound {}", s.x, s.y, threshold);
      }
    }
  }
  return "";
}

/// Sum of squared errors at samples; samples on edges count once per triangle.
inline double sum_of_squares(const grid::Raster& raster, const fit::Fitted& fitted) {
  double sum = 0;
  for (tin::Triangle t = 0; t < fitted.tin.triangle_count(); ++t) {
    if (fitted.tin.is_outside(t)) continue;
    const std::array<Point, 3> corners = fitted.tin.corners(t);
    const auto area = static_cast<double>(orient(corners[0], corners[1], corners[2]));
    for (Point s{0, 0}; s.y < raster.rows; ++s.y) {
      for (s.x = 0; s.x < raster.cols; ++s.x) {
        double height = 0;
        bool inside = raster.is_valid(s);
        for (unsigned k = 0; k < 3; ++k) {
          const std::int64_t weight = orient(corners[(k + 1) % 3], corners[(k + 2) % 3],
                                             {s.x * grid::kLatticeSteps, s.y * grid::kLatticeSteps});
          inside = inside && weight >= 0;
          height += static_cast<double>(weight) / area * double{fitted.lattice.heights[fitted.tin.origin(3 * t + k)]};
        }
        if (inside) sum += (height - raster.at(s)) * (height - raster.at(s));
      }
    }
  }
  return sum;
}

/// The ratio of height to longest edge as a fraction; exact if products of two numbers are integers below 2⁵³.
struct ShapeOracle {
  double area = 1, longest = 1;

  ShapeOracle(const std::array<Point, 3>& corners, double aspect)
      : area(aspect * static_cast<double>(orient(corners[0], corners[1], corners[2]))), longest(0) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = corners[k].x - corners[(k + 1) % 3].x, y = aspect * (corners[k].y - corners[(k + 1) % 3].y);
      longest = std::max(longest, x * x + y * y);
    }
  }
  explicit ShapeOracle(double quotient) : area(quotient) {}
  bool operator<(const ShapeOracle& other) const { return area * other.longest < other.area * longest; }
};

/// Worst shape of the triangles of the domain; at most `most`.
inline ShapeOracle worst_shape(const tin::Triangulation& tin, double aspect, ShapeOracle most) {
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (!tin.is_outside(t)) most = std::min(most, ShapeOracle(tin.corners(t), aspect));
  }
  return most;
}

/// Side of the rectangle of fitting's lattice vertices.
inline std::int32_t in_steps(std::int32_t side) { return (side - 1) * grid::kLatticeSteps + 1; }

}  // namespace scarp::testing
