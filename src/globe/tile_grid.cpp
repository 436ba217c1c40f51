#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "globe/sine.h"
#include "scarp/tile.h"

namespace scarp {
namespace {

constexpr double kDegrees = 57.29577951308232;

struct Named {
  GridKind kind;
  std::string_view name, projection;
};
constexpr Named kGrids[] = {{GridKind::kGeographic, "geographic", "EPSG:4326"},
                            {GridKind::kMercator, "mercator", "EPSG:3857"},
                            {GridKind::kLocal, "local", ""}};
/// The side of a tile of 65 samples, in geometric errors; each is a quarter of a sample.
constexpr double kErrorsOfSide = 260;

const Named& named(GridKind kind) {
  return *std::find_if(std::begin(kGrids), std::end(kGrids), [&](const Named& one) { return one.kind == kind; });
}

template <class Member>
std::optional<TileGrid> find_by(Member member, std::string_view text) {
  for (const Named& one : kGrids) {
    if (one.*member == text) return TileGrid{.kind = one.kind};
  }
  return {};
}

/// Rounds to 29 bits, so that products with integers of 24 bits are exact.
double rounded(double cell) {
  constexpr int kBits = 29;
  const int exponent = std::ilogb(cell) + 1 - kBits;
  return std::ldexp(std::floor(std::ldexp(cell, -exponent) + 0.5), exponent);
}

/// Latitude in degrees of a position on the Mercator map, −1 … 1 from the southern to the northern end of its square.
/// Uses only basic arithmetic, so the bits are the same on every machine; precise to 10⁻¹³ degrees.
double mercator_latitude(double place) {
  // φ = 2 atan(tanh(y / 2)), y = π · place; e^(−y) is the 16th power of e^(−y / 16), by Taylor's series.
  const double x = -std::numbers::pi * std::abs(place) / 16;
  double power = 0;
  for (int k = 14; k >= 1; --k) power = (1 + power) * x / k;
  power += 1;
  for (int k = 0; k < 4; ++k) power *= power;
  double tangent = (1 - power) / (1 + power);
  // Halve the angle twice, so that the arctangent series converges fast.
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
  return projection.empty() ? std::nullopt : find_by(&Named::projection, projection);
}

TileGrid TileGrid::of_raster(std::int32_t cols, std::int32_t rows, double cell_x, double cell_y, int cells) {
  TileGrid grid{GridKind::kLocal, {cols, rows, rounded(cell_x), rounded(cell_y), cells}};
  while (grid.local.side < std::max(cols, rows) - 1) grid.local.side *= 2;
  return grid;
}

int TileGrid::finest_local(int cells) const {
  int z = 0;
  while ((std::int64_t{cells} << z) < local.side) ++z;
  return z;
}

bool TileGrid::has(TileId id) const {
  if (id.z < 0 || id.z > kMaxTileLevel || id.x >= columns(id.z) || id.y >= rows(id.z)) return false;
  if (!is_flat()) return true;
  const DegreeBox box = bounds_of(id);
  return box.west < local.cols - 1 && box.south < local.rows - 1;
}

std::span<const double> TileGrid::turns() const {
  static constexpr std::array<double, 5> kTurns{-720, -360, 0, 360, 720};
  const std::span<const double> turns = kTurns;
  return is_flat() ? turns.subspan(2, 1) : turns;
}

NodeRange TileGrid::land_columns(std::int64_t per_turn) const {
  constexpr std::int64_t kAnywhere = std::int64_t{1} << 60;
  if (!is_flat()) return {-kAnywhere, kAnywhere};
  return {0, static_cast<std::int64_t>(std::ceil((local.cols - 1) / largest_step(per_turn)))};
}

NodeRange TileGrid::land_rows(std::int64_t per_turn) const {
  const std::int64_t last = last_row(per_turn);
  if (!is_flat()) return {0, last};
  return {last - static_cast<std::int64_t>(std::ceil((local.rows - 1) / largest_step(per_turn))), last};
}

double TileGrid::latitude(std::int64_t row, std::int64_t last_row) const {
  const double part = static_cast<double>(row) / static_cast<double>(last_row);
  if (is_flat()) return static_cast<double>(local.side) * (1 - part);
  return kind == GridKind::kMercator ? mercator_latitude(1 - 2 * part) : 90 - 180 * part;
}

double TileGrid::row_step(double latitude) const {
  return kind == GridKind::kMercator ? globe::sine_of_degrees(latitude).cosine : 1;
}

DegreeBox TileGrid::bounds() const {
  if (is_flat()) return bounds_of({0, 0, 0});
  return {-180, latitude(1, 1), 180, latitude(0, 1)};
}

DegreeBox TileGrid::bounds_of(TileId id) const {
  if (is_flat()) {
    const double cells = std::ldexp(static_cast<double>(local.side), -id.z);
    return {id.x * cells, id.y * cells, (id.x + 1.0) * cells, (id.y + 1.0) * cells};
  }
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
  if (is_flat()) return tile_width(z, semi_major) / kErrorsOfSide;
  return std::ldexp(semi_major * 2 * std::numbers::pi * 0.25 / (65 * roots()), -z);
}

double TileGrid::tile_width(int z, double semi_major) const {
  if (is_flat()) return std::ldexp(static_cast<double>(local.side) * std::max(local.cell_x, local.cell_y), -z);
  return std::ldexp(std::numbers::pi * semi_major * (2.0 / roots()), -z);
}

}  // namespace scarp
