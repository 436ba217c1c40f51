// The approximation as an image: each triangle interpolates its corners' values, one pixel per sample.
//
// Vertices near samples are snapped to the samples, because the frame may have rounded the vertices. So edge functions
// are exact. A sample on an edge or a corner belongs to the triangle, so no sample of the mesh stays white.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/canvas.h"
#include "draw/grid_positions.h"
#include "draw/relief.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

constexpr double kSnap = 1.0 / 64;  // samples; about the precision of a transform's inverse
constexpr double kSlack = 1e-9;     // share of a triangle's area, for vertices between samples

double snap(double at) { return std::abs(at - std::round(at)) < kSnap ? std::round(at) : at; }

/// Integers from lo to hi that are in 0 … size − 1, as [first, last].
std::pair<int, int> whole_between(double lo, double hi, int size) {
  return {static_cast<int>(std::clamp(std::ceil(lo), 0.0, double(size))),
          static_cast<int>(std::clamp(std::floor(hi), -1.0, size - 1.0))};
}

struct Facet {
  std::array<double, 3> x{}, y{};
  double area = 0, slack = 0;

  /// Twice the area of the triangle of side k and the point, positive inside.
  double part(std::size_t k, double col, double row) const {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    const double part = (x[b] - x[a]) * (row - y[a]) - (y[b] - y[a]) * (col - x[a]);
    return area > 0 ? part : -part;
  }
  /// A range of columns that contains all of the triangle's points in the row.
  std::pair<int, int> columns(int row, int cols) const {
    double lo = std::min({x[0], x[1], x[2]}), hi = std::max({x[0], x[1], x[2]});
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double dy = area > 0 ? y[b] - y[a] : y[a] - y[b];
      const double crossing = x[a] + (x[b] - x[a]) * (row - y[a]) / (y[b] - y[a]);
      if (dy > 0) hi = std::min(hi, crossing + 1);
      if (dy < 0) lo = std::max(lo, crossing - 1);
    }
    return whole_between(lo, hi, cols);
  }
};

/// Calls visit(col, row, v, weights) for every sample in a triangle that faces up, or on its border; the weights of its
/// corners v[0 … 2] add up to 1.
template <class Visit>
void visit_samples(const HeightField& field, const Mesh& mesh, Visit visit) {
  const draw::GridPositions at = draw::find_grid_positions(field.frame, field.cols, field.rows, mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* v = &mesh.triangles[3 * t];
    if (v[0] >= mesh.vertex_count() || v[1] >= mesh.vertex_count() || v[2] >= mesh.vertex_count()) return;
    Facet facet;
    std::array<double, 3> east{}, north{};
    bool on_samples = true;
    for (std::size_t k = 0; k < 3; ++k) {
      facet.x[k] = snap(at.cols[v[k]]);
      facet.y[k] = snap(at.rows[v[k]]);
      on_samples = on_samples && facet.x[k] == std::round(facet.x[k]) && facet.y[k] == std::round(facet.y[k]);
      east[k] = mesh.positions[3 * std::size_t{v[k]}];
      north[k] = mesh.positions[3 * std::size_t{v[k]} + 1];
    }
    if (!((east[1] - east[0]) * (north[2] - north[0]) - (north[1] - north[0]) * (east[2] - east[0]) > 0)) continue;
    facet.area =
        (facet.x[1] - facet.x[0]) * (facet.y[2] - facet.y[0]) - (facet.y[1] - facet.y[0]) * (facet.x[2] - facet.x[0]);
    if (facet.area == 0 || !std::isfinite(facet.area)) continue;
    facet.slack = on_samples ? 0 : kSlack * std::abs(facet.area);
    const auto [top, bottom] = std::minmax({facet.y[0], facet.y[1], facet.y[2]});
    const auto [first_row, last_row] = whole_between(top, bottom, field.rows);
    for (int row = first_row; row <= last_row; ++row) {
      const auto [first_col, last_col] = facet.columns(row, field.cols);
      for (int col = first_col; col <= last_col; ++col) {
        const std::array<double, 3> parts{facet.part(0, col, row), facet.part(1, col, row), facet.part(2, col, row)};
        if (std::min({parts[0], parts[1], parts[2]}) < -facet.slack) continue;
        const double whole = parts[0] + parts[1] + parts[2];
        visit(col, row, v, std::array<double, 3>{parts[0] / whole, parts[1] / whole, parts[2] / whole});
      }
    }
  }
}

Picture draw_colors(const HeightField& field, const Mesh& mesh) {
  Picture picture = draw::blank(field.cols, field.rows);
  visit_samples(field, mesh, [&](int col, int row, const std::uint32_t* v, const std::array<double, 3>& weights) {
    draw::Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c) colour[c] += weights[k] * mesh.colors[3 * std::size_t{v[k]} + c];
    }
    draw::set_pixel(picture, col, row, colour);
  });
  return picture;
}

Picture draw_hillshade(const HeightField& field, const Mesh& mesh) {
  draw::Relief relief{field.cols, field.rows, {}};
  const std::size_t size = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  relief.z.assign(size, std::numeric_limits<double>::quiet_NaN());
  visit_samples(field, mesh, [&](int col, int row, const std::uint32_t* v, const std::array<double, 3>& weights) {
    double z = 0;
    for (std::size_t k = 0; k < 3; ++k) z += weights[k] * mesh.positions[3 * std::size_t{v[k]} + 2];
    relief.z[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(col)] = z;
  });
  const auto colours =
      draw::shade(relief, draw::ground_of(field.frame, field.cols, field.rows), field.cols, field.rows).colours;
  Picture picture = draw::blank(field.cols, field.rows);
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(x);
      draw::set_pixel(picture, x, y, colours[i]);
    }
  }
  return picture;
}

}  // namespace

Picture draw_gouraud(const HeightField& field, const Mesh& mesh) {
  if (field.cols < 1 || field.rows < 1) return {};
  const bool has_colors = !mesh.colors.empty() && mesh.colors.size() == mesh.positions.size();
  return has_colors ? draw_colors(field, mesh) : draw_hillshade(field, mesh);
}

}  // namespace scarp
