#include "measure/space_judge.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace scarp::judge {
namespace {

using Vector = Verticals::Vector;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct SpacePoints {
  std::vector<double> x, y, z;

  void add(const Vector& p) {
    x.push_back(p[0]);
    y.push_back(p[1]);
    z.push_back(p[2]);
  }
};

Vector vertex(const Mesh& mesh, std::size_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

/// Four times half a unit in the last place of the positions.
double noise_of(const Mesh& mesh) {
  double largest = 0, farthest = 0;
  bool is_float = true;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double value = mesh.positions[i];
    largest = std::max(largest, std::abs(value));
    farthest = std::max(farthest, std::abs(mesh.origin[i % 3] + value));
    is_float = is_float && static_cast<double>(static_cast<float>(value)) == value;
  }
  return std::max(is_float ? largest * 0x1p-22 : 0, farthest * 0x1p-48);
}

/// Largest number of grid samples per metre, near the raster's centre.
double samples_per_metre(const HeightField& field) {
  const double col = field.cols / 2, row = field.rows / 2;
  SpacePoints at;
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
    const auto [x, y] = field.frame.apply_affine(col - i, row - j);
    at.add({x, y, 0});
  }
  field.frame.space->to_space(at.x, at.y, at.z);
  const auto length = [&](std::size_t k) {
    const Vector way{at.x[k] - at.x[0], at.y[k] - at.y[0], at.z[k] - at.z[0]};
    return std::sqrt(dot(way, way));
  };
  return 1 / std::min(length(1), length(2));
}

/// Columns and rows.
struct Inverse {
  std::array<double, 6> a;
  double determinant;

  explicit Inverse(const Frame& frame) : a(frame.affine), determinant(frame.determinant()) {}
  std::array<double, 2> operator()(double x, double y) const {
    const double dx = x - a[0], dy = y - a[3];
    return {(a[5] * dx - a[2] * dy) / determinant, (a[1] * dy - a[4] * dx) / determinant};
  }
};

double snapped(double value, double noise) {
  constexpr double kSteps = 256;
  const double place = std::round(value * kSteps) / kSteps;
  return std::abs(value - place) <= std::min(noise, 0.25 / kSteps) ? place : value;
}

/// A length along a vertical, in metres, that is large relative to the rounding of coordinates.
constexpr double kRise = 1000;

}  // namespace

HeightField on_map(const HeightField& field) {
  HeightField flat = field;
  flat.frame.kind = Frame::Kind::kSource;
  flat.frame.space = nullptr;
  return flat;
}

Result<Mesh> bring_to_map(const HeightField& field, const Mesh& mesh) {
  SpacePoints at;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) at.add(mesh.vertex(v));
  field.frame.space->from_space(at.x, at.y, at.z);
  const Inverse to_grid(field.frame);
  const double noise = noise_of(mesh) * samples_per_metre(field);
  Mesh flat;
  flat.triangles = mesh.triangles;
  flat.positions.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto [col, row] = to_grid(at.x[v], at.y[v]);
    if (!std::isfinite(col) || !std::isfinite(row) || !std::isfinite(at.z[v]))
      return fail(ErrorKind::kInput, fmt::format("vertex {} of the mesh has no place in the raster's coordinates", v));
    const auto [x, y] = field.frame.apply_affine(snapped(col, noise), snapped(row, noise));
    flat.positions.insert(flat.positions.end(), {x, y, at.z[v]});
  }
  return flat;
}

Mesh seen_from_above(const HeightField& field, const Mesh& mesh) {
  const Vector up = field.frame.space->up();
  const Vector side = std::abs(up[2]) < 0.9 ? cross({0, 0, 1}, up) : cross({1, 0, 0}, up);
  const double length = std::sqrt(dot(side, side));
  const Vector east{side[0] / length, side[1] / length, side[2] / length}, north = cross(up, east);
  Mesh seen;
  seen.triangles = mesh.triangles;
  seen.positions.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vector p = vertex(mesh, v);
    seen.positions.insert(seen.positions.end(), {dot(p, east), dot(p, north), dot(p, up)});
  }
  return seen;
}

Verticals::Verticals(const Frame& frame, const Vector& origin, const Band& band)
    : first_(band.first()), cols_(static_cast<std::size_t>(band.cols())) {
  SpacePoints feet, tops;
  for (int row = band.first(); row < band.end(); ++row) {
    for (int col = 0; col < band.cols(); ++col) {
      const auto [x, y] = frame.apply_affine(col, row);
      feet.add({x, y, 0});
      tops.add({x, y, kRise});
    }
  }
  frame.space->to_space(feet.x, feet.y, feet.z);
  frame.space->to_space(tops.x, tops.y, tops.z);
  lines_.resize(feet.x.size());
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto row = band.first() + static_cast<int>(k / cols_);
    const double height = band.heights(row)[k % cols_];
    Line& line = lines_[k];
    line.up = {(tops.x[k] - feet.x[k]) / kRise, (tops.y[k] - feet.y[k]) / kRise, (tops.z[k] - feet.z[k]) / kRise};
    line.sample = {(feet.x[k] - origin[0]) + height * line.up[0], (feet.y[k] - origin[1]) + height * line.up[1],
                   (feet.z[k] - origin[2]) + height * line.up[2]};
  }
}

SpaceJudge::SpaceJudge(const HeightField& field, const Mesh& mesh, const Mesh& on_map,
                       std::span<const std::uint32_t> ids)
    : field_(field), frame_(field.frame), mesh_(mesh), on_map_(on_map), bends_(mesh.triangle_count(), 0) {
  constexpr std::size_t kAtOnce = 4096;
  for (std::size_t begin = 0; begin < ids.size(); begin += kAtOnce) {
    const auto part = ids.subspan(begin, std::min(kAtOnce, ids.size() - begin));
    find_bends(part);
    find_folds(part);
  }
}

void SpaceJudge::find_bends(std::span<const std::uint32_t> ids) {
  const Inverse to_grid(frame_);
  SpacePoints middles;
  const auto each_edge = [&](const auto& visit) {
    for (const std::uint32_t id : ids) {
      const std::uint32_t* corner = &mesh_.triangles[3 * std::size_t{id}];
      for (std::size_t k = 0; k < 3; ++k) visit(id, corner[k], corner[(k + 1) % 3]);
    }
  };
  each_edge([&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
    const Vector p = mesh_.vertex(a), q = mesh_.vertex(b);
    middles.add({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
  });
  frame_.space->from_space(middles.x, middles.y, middles.z);
  std::size_t edge = 0;
  each_edge([&](std::uint32_t id, std::uint32_t a, std::uint32_t b) {
    const Vector p = vertex(on_map_, a), q = vertex(on_map_, b);
    const auto straight = to_grid((p[0] + q[0]) / 2, (p[1] + q[1]) / 2);
    const auto bent = to_grid(middles.x[edge], middles.y[edge]);
    ++edge;
    // The bend is largest near the middle and stays below twice this value.
    const double off = 2 * std::hypot(bent[0] - straight[0], bent[1] - straight[1]);
    bends_[id] = std::max(bends_[id], std::isfinite(off) ? static_cast<float>(off) : HUGE_VALF);
  });
}

void SpaceJudge::find_folds(std::span<const std::uint32_t> ids) {
  SpacePoints tops;
  for (const std::uint32_t id : ids) {
    const Vector foot = vertex(on_map_, mesh_.triangles[3 * std::size_t{id}]);
    tops.add({foot[0], foot[1], foot[2] + kRise});
  }
  frame_.space->to_space(tops.x, tops.y, tops.z);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t* corner = &mesh_.triangles[3 * std::size_t{ids[i]}];
    const Vector at = mesh_.vertex(corner[0]), up = minus({tops.x[i], tops.y[i], tops.z[i]}, at);
    const auto [p, q, r] = corners(ids[i]).at;
    const Vector a = vertex(on_map_, corner[0]), b = vertex(on_map_, corner[1]), c = vertex(on_map_, corner[2]);
    const double on_map = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double in_space = dot(cross(minus(q, p), minus(r, p)), up);
    if (on_map != 0 && !(on_map * in_space > 0)) folded_.push_back(ids[i]);
  }
}

std::vector<Offender> SpaceJudge::unfolding() const {
  const Inverse to_grid(frame_);
  std::vector<Offender> samples;
  for (const std::uint32_t id : folded_) {
    std::array<std::array<double, 2>, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector p = vertex(on_map_, mesh_.triangles[3 * std::size_t{id} + k]);
      at[k] = to_grid(p[0], p[1]);
    }
    double longest = 0;
    Offender middle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &p = at[k], &q = at[(k + 1) % 3];
      const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
      if (length <= longest) continue;
      longest = length;
      middle = {static_cast<std::int32_t>(std::lround((p[0] + q[0]) / 2)),
                static_cast<std::int32_t>(std::lround((p[1] + q[1]) / 2)), HUGE_VAL};
    }
    const bool is_inside = middle.col >= 0 && middle.row >= 0 && middle.col < field_.cols && middle.row < field_.rows;
    if (longest >= 2 && is_inside) samples.push_back(middle);
  }
  return samples;
}

SpaceJudge::Corners SpaceJudge::corners(std::uint32_t id) const {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) corners.at[k] = vertex(mesh_, mesh_.triangles[3 * std::size_t{id} + k]);
  return corners;
}

void SpaceJudge::judge_met(const Facet& facet, std::uint32_t id, const Verticals& verticals, Band& band) const {
  const Corners corners = this->corners(id);
  const double reach = bend(id) + 1e-6;
  const Interval along = facet.plan.y_extent();
  const auto whole = [](double value, double least, double most) {
    return static_cast<int>(std::clamp(value, least, most));
  };
  const int first = whole(std::ceil(along.lo - reach), band.first(), band.end()),
            last = whole(std::floor(along.hi + reach), band.first() - 1, band.end() - 1);
  Offender worst;
  for (int row = first; row <= last; ++row) {
    const Interval across = facet.plan.x_range(row - reach, row + reach);
    const int begin = whole(std::ceil(across.lo - reach), 0, band.cols()),
              end = whole(std::floor(across.hi + reach), -1, band.cols() - 1);
    const float* heights = band.heights(row);
    for (int col = begin; col <= end; ++col) {
      if (std::isnan(heights[col])) continue;
      // Corners relative to the sample: heights along its vertical, and areas seen along the vertical.
      const Verticals::Line& line = verticals.at(col, row);
      std::array<Vector, 3> away{};
      for (std::size_t k = 0; k < 3; ++k) away[k] = minus(corners.at[k], line.sample);
      std::array<double, 3> weight{};
      double sum = 0, size = 0, rise = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector &p = away[(k + 1) % 3], &q = away[(k + 2) % 3];
        weight[k] = dot(cross(p, q), line.up);
        sum += weight[k];
        size = std::max(size, dot(p, p));
        rise += weight[k] * dot(away[k], line.up);
      }
      const double side = sum < 0 ? -1 : 1, slack = -1e-12 * size;
      if (sum == 0 || side * weight[0] < slack || side * weight[1] < slack || side * weight[2] < slack) continue;
      const double error = rise / sum;
      band.offer(band.errors(row)[col], error);
      if (band.is_offender(col, row, error) && std::abs(error) > std::abs(worst.error)) worst = {col, row, error};
    }
  }
  if (worst.error != 0) band.add_offender(id, worst);
}

double SpaceJudge::error_beside(std::uint32_t id, int col, int row, const Verticals& verticals) const {
  const Corners corners = this->corners(id);
  const Verticals::Line& line = verticals.at(col, row);
  double least = INFINITY, error = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector p = minus(corners.at[k], line.sample), edge = minus(corners.at[(k + 1) % 3], corners.at[k]);
    const double edge_up = dot(edge, line.up), p_up = dot(p, line.up);
    const double length = dot(edge, edge) - edge_up * edge_up;
    const double t = length > 0 ? std::clamp(-(dot(p, edge) - p_up * edge_up) / length, 0.0, 1.0) : 0;
    const Vector nearest{p[0] + t * edge[0], p[1] + t * edge[1], p[2] + t * edge[2]};
    const double height = dot(nearest, line.up), off = dot(nearest, nearest) - height * height;
    if (off >= least) continue;
    least = off;
    error = height;
  }
  return error;
}

}  // namespace scarp::judge
