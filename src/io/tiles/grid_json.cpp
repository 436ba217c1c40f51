#include "io/tiles/grid_json.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp::io {
namespace {

constexpr double kMostSamples = 1 << 30;
/// Most cells per side of a tile. A larger square must be the smallest one that contains the raster.
constexpr double kMostCells = 256;

}  // namespace

Json describe_grid(const TileGrid& grid) {
  Json json{{"kind", grid.name()}};
  if (!grid.is_flat()) return json;
  json["samples"] = {grid.local.cols, grid.local.rows};
  json["cell"] = {grid.local.cell_x, grid.local.cell_y};
  json["side"] = grid.local.side;
  return json;
}

std::optional<TileGrid> parse_grid(const Json& json) {
  const Json* const kind = find_member(&json, "kind");
  std::optional<TileGrid> grid =
      kind != nullptr && kind->is_string() ? TileGrid::find(kind->get<std::string>()) : std::nullopt;
  if (!grid || !grid->is_flat()) return grid;
  std::array<double, 2> samples{}, cell{};
  const auto read_pair = [&](const char* name, std::array<double, 2>& pair) {
    const Json* const found = find_member(&json, name);
    if (found == nullptr || !found->is_array() || found->size() != 2) return false;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!(*found)[k].is_number()) return false;
      pair[k] = (*found)[k].get<double>();
    }
    return true;
  };
  const auto side = find_number(&json, "side");
  if (!side || !read_pair("samples", samples) || !read_pair("cell", cell)) return {};
  const auto is_count = [](double number) {
    return number >= 2 && number <= kMostSamples && number == std::floor(number);
  };
  const auto is_length = [](double number) { return number > 0 && number < 1e9; };
  if (!is_count(samples[0]) || !is_count(samples[1]) || !is_length(cell[0]) || !is_length(cell[1])) return {};
  double square = 1;
  while (square < *side && square <= kMostSamples) square *= 2;
  const double needed = std::max(samples[0], samples[1]) - 1;
  if (square != *side || square < needed || (square > kMostCells && square / 2 >= needed)) return {};
  grid->local = {static_cast<std::int32_t>(samples[0]), static_cast<std::int32_t>(samples[1]), cell[0], cell[1],
                 static_cast<std::int64_t>(*side)};
  return grid;
}

}  // namespace scarp::io
