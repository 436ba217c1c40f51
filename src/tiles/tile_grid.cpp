#include "scarp/tile_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tiles/sine.h"

namespace scarp {
namespace {

constexpr double kPi = 3.141592653589793, kDegrees = 57.29577951308232;

struct Named {
  GridKind kind;
  std::string_view name, projection;
};
constexpr Named kGrids[] = {{GridKind::kGeographic, "geographic", "EPSG:4326"},
                            {GridKind::kMercator, "mercator", "EPSG:3857"}};

const Named& named(GridKind kind) {
  return *std::find_if(std::begin(kGrids), std::end(kGrids), [&](const Named& one) { return one.kind == kind; });
}

template <class Member>
std::optional<TileGrid> find_by(Member member, std::string_view text) {
  for (const Named& one : kGrids) {
    if (one.*member == text) return TileGrid{one.kind};
  }
  return {};
}

/// Degrees of a place on the map of Mercator, −1 … 1 from the southern to the northern end of its square. Of arithmetic
/// alone, so that the bits are the same on every machine; within 10⁻¹³ degrees.
double mercator_latitude(double place) {
  // φ = 2 atan(tanh(y / 2)), y = π · place; e^(−y) is the 16th power of that of y / 16, by Taylor's series.
  const double x = -kPi * std::abs(place) / 16;
  double power = 0;
  for (int k = 14; k >= 1; --k) power = (1 + power) * x / k;
  power += 1;
  for (int k = 0; k < 4; ++k) power *= power;
  double tangent = (1 - power) / (1 + power);
  // Half the angle twice, so that the series of the arc ends soon.
  for (int k = 0; k < 2; ++k) tangent /= 1 + std::sqrt(1 + tangent * tangent);
  const double square = tangent * tangent;
  double arc = 0;
  for (int k = 27; k >= 1; k -= 2) arc = 1.0 / k - square * arc;
  return std::copysign(8 * kDegrees * tangent * arc, place);
}

}  // namespace

std::string_view TileGrid::name() const { return named(kind).name; }
std::string_view TileGrid::projection() const { return named(kind).projection; }
std::optional<TileGrid> TileGrid::find(std::string_view name) { return find_by(&Named::name, name); }
std::optional<TileGrid> TileGrid::find_projection(std::string_view projection) {
  return find_by(&Named::projection, projection);
}

std::span<const double> TileGrid::turns() const {
  static constexpr std::array<double, 5> kTurns{-720, -360, 0, 360, 720};
  return kTurns;
}

double TileGrid::latitude(std::int64_t row, std::int64_t last_row) const {
  const double part = static_cast<double>(row) / static_cast<double>(last_row);
  return kind == GridKind::kMercator ? mercator_latitude(1 - 2 * part) : 90 - 180 * part;
}

double TileGrid::row_step(double latitude) const {
  return kind == GridKind::kMercator ? sine_of_degrees(latitude).cosine : 1;
}

DegreeBox TileGrid::bounds() const { return {-180, latitude(1, 1), 180, latitude(0, 1)}; }

DegreeBox TileGrid::bounds_of(TileId id) const {
  const double side = std::ldexp(360.0 / roots(), -id.z);
  const std::int64_t down = rows(id.z);
  return {-180 + id.x * side, latitude(down - id.y, down), -180 + (id.x + 1.0) * side, latitude(down - 1 - id.y, down)};
}

NodeWindow TileGrid::window_of(TileId id, std::int32_t steps, std::int32_t halo) const {
  NodeWindow window{per_turn(id.z, steps), std::int64_t{id.x} * steps - halo, 0, steps + 1 + 2 * halo, 0, *this};
  const std::int64_t row = (std::int64_t{rows(id.z)} - 1 - id.y) * steps;
  window.row = std::max<std::int64_t>(row - halo, 0);
  window.rows = static_cast<int>(std::min(row + steps + halo, window.last_row()) - window.row + 1);
  return window;
}

double TileGrid::geometric_error(int z, double semi_major) const {
  return std::ldexp(semi_major * 2 * kPi * 0.25 / (65 * roots()), -z);
}

double TileGrid::tile_width(int z, double semi_major) const {
  return std::ldexp(kPi * semi_major * (2.0 / roots()), -z);
}

}  // namespace scarp
