// The data by which clients cull tiles: heights, sphere, centre, and horizon point.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/tile_faults.h"

namespace scarp::check {
namespace {

/// Relative effect of rounding to doubles.
constexpr double kSlack = 1e-6;
/// Cameras around the tile at the horizon of its horizon point: number of directions, and distances beyond it.
constexpr int kDirections = 64;
constexpr double kBeyond[] = {0.001, 0.05, 2};
/// Cameras above the tile, in units of the axes.
constexpr double kAbove[] = {1.0005, 1.01, 1.2, 4};

bool is_finite(const Place& at) { return std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]); }

/// The test of CesiumJS and cesium-native, on the sphere of radius 1.
bool hides(const Place& point, const Place& camera) {
  const double beyond = inner(camera, camera) - 1;
  const Place way = point - camera;
  const double along = -inner(way, camera);
  return beyond < 0 ? along > 0 : along > beyond && along * along > beyond * inner(way, way);
}

/// True if the line from the camera to a vertex stays outside the sphere.
bool sees(const Place& camera, const Place& vertex) {
  const Place way = vertex - camera;
  const double square = inner(way, way);
  const double t = square > 0 ? std::clamp(-inner(camera, way) / square, 0.0, 1.0) : 0;
  const Place nearest = camera + t * way;
  return inner(nearest, nearest) > 1 + 1e-9;
}

/// True if the camera sees one of the vertices while the point hides the tile from it.
bool is_hidden_wrongly(const Place& point, const std::vector<Place>& vertices, const Place& camera) {
  if (!hides(point, camera)) return false;
  return std::any_of(vertices.begin(), vertices.end(), [&](const Place& vertex) { return sees(camera, vertex); });
}

}  // namespace

void check_header(const ClientTile& tile, std::vector<TileFault>& faults) {
  const std::string name = tile_name(tile.format, tile.id);
  const auto add = [&](const std::string& what) {
    faults.push_back({TileFaultKind::kHeader, fmt::format("{} {}", name, what)});
  };
  if (!std::isfinite(tile.low) || !std::isfinite(tile.high) || tile.low > tile.high)
    return add(fmt::format("says that its heights are {} to {} m", tile.low, tile.high));
  const auto [lowest, highest] = std::minmax_element(tile.heights.begin(), tile.heights.end());
  if (*lowest < tile.low - kSlack || *highest > tile.high + kSlack)
    add(fmt::format("has heights of {:.9g} to {:.9g} m and says {:.9g} to {:.9g} m", *lowest, *highest, tile.low,
                    tile.high));
  if (!is_finite(tile.sphere_centre) || !(tile.radius > 0) || !std::isfinite(tile.radius))
    return add("has no bounding sphere");
  double farthest = 0;
  for (const Place& at : tile.places) farthest = std::max(farthest, length(at - tile.sphere_centre));
  const double slack = 1e-3 + kSlack * tile.radius;
  if (farthest > tile.radius + slack)
    add(fmt::format("has a vertex {:.3f} m outside of its bounding sphere, whose radius is {:.3f} m",
                    farthest - tile.radius, tile.radius));
  // A sphere that is much too large does not spoil drawing; a sphere at another place does.
  if (tile.radius > 4 * farthest + 1000)
    add(fmt::format("has a bounding sphere of {:.3f} m around vertices at most {:.3f} m from its centre", tile.radius,
                    farthest));
  if (tile.centre && (!is_finite(*tile.centre) || length(*tile.centre - tile.sphere_centre) > tile.radius + slack))
    add("has a centre outside of its bounding sphere");
}

void check_horizon(const ClientTile& tile, const World& world, std::vector<TileFault>& faults) {
  const Place& point = tile.horizon;
  if (std::isnan(point[0]) || std::isnan(point[1]) || std::isnan(point[2])) return;  // never hidden
  const std::string name = tile_name(tile.format, tile.id);
  const auto add = [&] {
    faults.push_back({TileFaultKind::kHorizon,
                      fmt::format("{} is hidden by its horizon point from a camera that sees a vertex of it", name)});
  };
  const double far = length(point);
  if (!std::isfinite(far) || !(far > 0)) return add();
  // Points below the surface count as surface points.
  std::vector<Place> vertices;
  for (const Place& at : tile.places) {
    const Place place = world.scaled(at);
    const double out = length(place);
    vertices.push_back(out < 1 ? (1 / out) * place : place);
  }
  const Place up = (1 / far) * point;
  for (const double out : kAbove) {
    if (is_hidden_wrongly(point, vertices, out * up)) return add();
  }
  if (far <= 1) return;
  // Cameras around the tile, beyond the point where the ray through the horizon point touches the sphere.
  const Place side = std::abs(up[2]) < 0.9 ? cross(up, {0, 0, 1}) : cross(up, {1, 0, 0});
  const Place across = (1 / length(side)) * side, along = cross(up, across);
  const double cosine = 1 / far, sine = std::sqrt(1 - cosine * cosine);
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * 3.141592653589793 * k / kDirections;
    const Place touched = cosine * up + sine * (std::cos(angle) * across + std::sin(angle) * along);
    // From there, only vertices above the sphere's tangent plane at that point are visible.
    const auto highest = std::max_element(vertices.begin(), vertices.end(), [&](const Place& a, const Place& b) {
      return inner(a, touched) < inner(b, touched);
    });
    if (inner(*highest, touched) <= 1) continue;
    const Place ray = touched - point;
    for (const double beyond : kBeyond) {
      const Place camera = (1 + 1e-12) * touched + (beyond / length(ray)) * ray - 1e-9 * touched;
      if (is_hidden_wrongly(point, {*highest}, camera)) return add();
    }
  }
}

double measure_sag(const ClientTile& tile, const World& world) {
  double worst = 0;
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    const Place &a = tile.places[tile.triangles[k]], &b = tile.places[tile.triangles[k + 1]],
                &c = tile.places[tile.triangles[k + 2]];
    std::array<double, 3> sides{length(a - b), length(b - c), length(c - a)};
    std::sort(sides.begin(), sides.end());
    // The radius of its smallest enclosing circle.
    const double area = length(cross(b - a, c - a)) / 2;
    const bool is_blunt = sides[2] * sides[2] >= sides[0] * sides[0] + sides[1] * sides[1];
    const double radius = is_blunt || area == 0 ? sides[2] / 2 : sides[0] * sides[1] * sides[2] / (4 * area);
    worst = std::max(worst, radius * radius / (2 * world.least_radius()));
  }
  return worst;
}

void check_water_mask(const ClientTile& tile, bool is_announced, std::vector<TileFault>& faults) {
  constexpr std::size_t kTexels = 256 * 256;
  const std::size_t size = tile.water_mask.size();
  if (size == 1 || size == kTexels || (size == 0 && !is_announced)) return;
  const std::string name = tile_name(tile.format, tile.id);
  faults.push_back({TileFaultKind::kFile,
                    size == 0
                        ? name + " has no water mask, and layer.json says that tiles have one"
                        : fmt::format("{} has a water mask of {} bytes instead of 1 or {}", name, size, kTexels)});
}

}  // namespace scarp::check
