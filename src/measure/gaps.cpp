// Holes in the surface.
//
// A triangle whose samples all lie on its edges can be missing without uncovering any sample. The border of the hole
// reveals it: edges with one triangle, beyond which the domain continues. So each open edge is split where it crosses
// the lattice lines. Then the raster is tested for surface slightly outside the middle of each piece.
//
// Surface there is not always a fault. If the outline was simplified, a thin wedge of nodata can separate an edge from
// other surface. Then the tested point is covered, and the edge lies in nodata. An edge is a gap only if the point is
// uncovered, or if no nodata separates the point from the edge (a crack thinner than the step outwards). Likewise, a
// slit of the cutline may separate an edge from the surface next to it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "measure/bucket_grid.h"
#include "measure/height_marks.h"
#include "measure/scanner.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

struct Point {
  double x = 0, y = 0;
};

/// The points of the grid that belong to the domain.
class ValidDomain {
 public:
  explicit ValidDomain(const HeightField& field) : field_(field), marks_(field) {}

  double last_col() const { return field_.cols - 1.0; }
  double last_row() const { return field_.rows - 1.0; }

  /// True if p lies in a cell of four heights, or in the half cell of three. `is_beside`: the adjacent point q lies in
  /// the same cell, up to `noise`.
  bool has_surface(const Point& p, const Point& q, double noise, bool& is_beside) {
    if (!(p.x >= 0 && p.y >= 0 && p.x < last_col() && p.y < last_row())) return false;
    const int col = static_cast<int>(p.x), row = static_cast<int>(p.y);
    int missing = -1;
    for (int k = 0; k < 4; ++k) {
      if (marks_.is_height(col + k % 2, row + k / 2)) continue;
      if (missing >= 0) return false;
      missing = k;
    }
    const double x = p.x - col, y = p.y - row, qx = q.x - col, qy = q.y - row;
    is_beside = qx >= -noise && qx <= 1 + noise && qy >= -noise && qy <= 1 + noise;
    if (missing < 0) return true;
    const auto from_corner = [missing](double u, double v) {
      return (missing % 2 == 0 ? u : 1 - u) + (missing / 2 == 0 ? v : 1 - v);
    };
    is_beside = is_beside && from_corner(qx, qy) >= 1 - noise;
    return from_corner(x, y) >= 1;
  }

  const Result<void>& failure() const { return marks_.failure(); }

 private:
  const HeightField& field_;
  HeightMarks marks_;
};

/// The crossings of the line from a to b with lattice lines, within the raster: ascending, as fractions of the line,
/// including both ends. Empty if the line is outside the raster.
void cut_at_lattice(const ValidDomain& domain, const Point& a, const Point& b, std::vector<double>& cuts) {
  cuts.clear();
  double first = 0, last = 1;
  const auto clip = [&](double from, double to, double least, double most) {
    const double run = to - from;
    if (run == 0) {
      if (from < least || from > most) last = -1;
      return;
    }
    const double t0 = (least - from) / run, t1 = (most - from) / run;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  };
  // Extends the raster by half a sample, to include edges that are outside by rounding.
  clip(a.x, b.x, -0.5, domain.last_col() + 0.5);
  clip(a.y, b.y, -0.5, domain.last_row() + 0.5);
  if (!(first < last)) return;
  cuts.push_back(first);
  cuts.push_back(last);
  const auto cross = [&](double from, double to) {
    const double run = to - from, u = from + first * run, v = from + last * run;
    if (run == 0) return;
    for (double line = std::ceil(std::min(u, v)); line <= std::max(u, v); ++line) {
      const double t = (line - from) / run;
      if (t > first && t < last) cuts.push_back(t);
    }
  };
  cross(a.x, b.x);
  cross(a.y, b.y);
  std::sort(cuts.begin(), cuts.end());
}

/// Positions of vertices in the grid; NaN if the frame cannot be inverted there. Frames that are not affine are
/// inverted by Newton's method from the raster's centre.
std::vector<Point> map_to_grid(const HeightField& field, const Mesh& mesh, const std::vector<std::uint32_t>& vertices) {
  const Frame& frame = field.frame;
  const std::size_t count = vertices.size();
  std::vector<Point> found(count, {(field.cols - 1) / 2.0, (field.rows - 1) / 2.0});
  const auto image = [&](double shift_x, double shift_y, std::vector<double>& x, std::vector<double>& y) {
    x.resize(count);
    y.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [px, py] = frame.apply_affine(found[i].x + shift_x, found[i].y + shift_y);
      x[i] = px;
      y[i] = py;
    }
    if (frame.transform) frame.transform->apply(x, y);
  };
  const auto& a = frame.affine;
  const int steps = frame.is_affine() ? 1 : 12;
  std::vector<double> x, y, right_x, right_y, down_x, down_y, moved(count);
  for (int step = 0; step < steps; ++step) {
    image(0, 0, x, y);
    if (frame.transform) {
      image(0.5, 0, right_x, right_y);
      image(0, 0.5, down_x, down_y);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double* p = &mesh.positions[3 * std::size_t{vertices[i]}];
      const double dx = (mesh.origin[0] - x[i]) + p[0], dy = (mesh.origin[1] - y[i]) + p[1];
      const double cx = frame.transform ? 2 * (right_x[i] - x[i]) : a[1],
                   cy = frame.transform ? 2 * (right_y[i] - y[i]) : a[4],
                   rx = frame.transform ? 2 * (down_x[i] - x[i]) : a[2],
                   ry = frame.transform ? 2 * (down_y[i] - y[i]) : a[5];
      const double det = cx * ry - cy * rx;
      const Point by{(ry * dx - rx * dy) / det, (cx * dy - cy * dx) / det};
      moved[i] = std::max(std::abs(by.x), std::abs(by.y));
      found[i] = {found[i].x + by.x, found[i].y + by.y};
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_found =
        std::isfinite(found[i].x) && std::isfinite(found[i].y) && (frame.is_affine() || moved[i] < 1e-4);
    if (!is_found) found[i] = {std::numeric_limits<double>::quiet_NaN(), 0};
  }
  return found;
}

/// A point of the domain next to an open edge: a gap if no triangle covers it.
struct Doubt {
  std::uint32_t edge = 0;
  Point at;  ///< in the grid
};

/// Marks the edges of doubts whose points no triangle covers.
void settle(const HeightField& field, const Mesh& mesh, const std::vector<Doubt>& doubts, std::vector<bool>& is_gap) {
  std::vector<double> x, y;
  for (const Doubt& doubt : doubts) {
    const auto [px, py] = field.frame.apply_affine(doubt.at.x, doubt.at.y);
    x.push_back(px);
    y.push_back(py);
  }
  if (field.frame.transform) field.frame.transform->apply(x, y);
  Box box;
  for (std::size_t i = 0; i < doubts.size(); ++i) {
    x[i] -= mesh.origin[0];
    y[i] -= mesh.origin[1];
    if (std::isfinite(x[i]) && std::isfinite(y[i])) box.include(x[i], y[i]);
  }
  if (!(box.x0 <= box.x1)) return;
  const auto plan_of = [&](std::size_t t) {
    Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      facet.plan.x[k] = mesh.positions[3 * std::size_t{mesh.triangles[3 * t + k]}];
      facet.plan.y[k] = mesh.positions[3 * std::size_t{mesh.triangles[3 * t + k]} + 1];
    }
    make_counter_clockwise(facet);
    return facet.plan;
  };
  BucketGrid grid(box, std::max(doubts.size(), mesh.triangle_count()));
  grid.fill([&](const auto& visit) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const PlanTriangle plan = plan_of(t);
      if (plan.double_area() > 0) visit(static_cast<std::uint32_t>(t), plan);
    }
  });
  for (std::size_t i = 0; i < doubts.size(); ++i) {
    if (is_gap[doubts[i].edge] || !std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    const auto bucket = grid.bucket(grid.col_of(x[i]), grid.row_of(y[i]));
    is_gap[doubts[i].edge] =
        std::none_of(bucket.begin(), bucket.end(), [&](std::uint32_t t) { return plan_of(t).contains(x[i], y[i]); });
  }
}

}  // namespace

Result<std::uint64_t> count_gaps(const HeightField& field, const Mesh& mesh, const Connections& connections,
                                 double tolerance, const CutRegion* region) {
  const std::vector<OpenEdge>& open = connections.edges.open;
  if (open.empty()) return 0;
  // Ends of the edge, then the triangle's third corner.
  std::vector<std::uint32_t> vertices;
  for (const OpenEdge& edge : open) {
    vertices.insert(vertices.end(), {edge.from, edge.to});
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = connections.vertex(mesh.triangles[3 * std::size_t{edge.triangle} + k]);
      if (v != edge.from && v != edge.to) vertices.push_back(v);
    }
  }
  const std::vector<Point> points = map_to_grid(field, mesh, vertices);
  ValidDomain domain(field);
  const double step = std::clamp(4 * tolerance, 1.0 / 64, 0.25);
  // Smaller than any wedge between lattice edges of a raster in memory, larger than the rounding of a mapped vertex.
  constexpr double kNoise = 1e-7;

  std::vector<bool> is_gap(open.size());
  std::vector<Doubt> doubts;
  std::vector<double> cuts;
  for (std::size_t e = 0; e < open.size(); ++e) {
    const Point a = points[3 * e], b = points[3 * e + 1], c = points[3 * e + 2];
    if (std::isnan(a.x) || std::isnan(b.x) || std::isnan(c.x)) continue;
    const double ux = b.x - a.x, uy = b.y - a.y, length = std::hypot(ux, uy);
    if (!(length > 0)) continue;
    const double inside = ux * (c.y - a.y) - uy * (c.x - a.x);
    const bool is_flat = std::abs(inside) <= kNoise * length;  // a wall has two outer sides
    cut_at_lattice(domain, a, b, cuts);
    double longest = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) longest = std::max(longest, cuts[i + 1] - cuts[i]);
    for (std::size_t i = 0; i + 1 < cuts.size() && !is_gap[e]; ++i) {
      // A rounded vertex causes a short piece beyond its lattice line, next to a cell that the edge does not touch.
      if ((cuts[i + 1] - cuts[i]) * length < 4 * step && cuts[i + 1] - cuts[i] < longest) continue;
      const double t = (cuts[i] + cuts[i + 1]) / 2;
      const Point middle{a.x + t * ux, a.y + t * uy};
      for (const double side : {-1.0, 1.0}) {
        if (!is_flat && side * inside > 0) continue;
        const Point beside{middle.x - side * step * uy / length, middle.y + side * step * ux / length};
        bool no_nodata_between = false;
        if (!domain.has_surface(beside, middle, kNoise, no_nodata_between)) continue;
        const bool is_cut_off = region != nullptr && (region->is_near(beside.x, beside.y, 2 * CutRegion::kNear) ||
                                                      !region->holds(beside.x, beside.y));
        if (is_cut_off) continue;
        const bool ends_at_ring = region != nullptr && region->is_near(middle.x, middle.y, 2 * CutRegion::kNear);
        if (no_nodata_between && !is_flat && !ends_at_ring) {
          is_gap[e] = true;
          break;
        }
        doubts.push_back({static_cast<std::uint32_t>(e), beside});
      }
    }
  }
  SCARP_RETURN_IF_ERROR(domain.failure());
  if (!doubts.empty()) settle(field, mesh, doubts, is_gap);
  return static_cast<std::uint64_t>(std::count(is_gap.begin(), is_gap.end(), true));
}

}  // namespace scarp::judge
