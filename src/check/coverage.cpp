// Triangles cover a tile once if each faces up, each edge has its reverse in another triangle or lies on the tile's own
// edge, and (for integer positions) all areas add up to the square. Then the number of triangles above a position
// changes only at the outline, and is 1 on average.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "check/tile_faults.h"

namespace scarp::check {
namespace {

constexpr unsigned side_bit(std::size_t side) { return 1u << side; }

/// The sides of the tile on which each vertex lies: by its position if that is exact, otherwise by the edge lists.
std::vector<unsigned> find_sides(const ClientTile& tile) {
  std::vector<unsigned> sides(tile.u.size());
  if (tile.format == TileFormat::kGlb) {
    for (std::size_t side = 0; side < tile.edges.size(); ++side) {
      for (const std::uint32_t v : tile.edges[side]) sides[v] |= side_bit(side);
    }
    return sides;
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (tile.u[k] == 0) sides[k] |= side_bit(kWest);
    if (tile.v[k] == 0) sides[k] |= side_bit(kSouth);
    if (tile.u[k] == kWholeTile) sides[k] |= side_bit(kEast);
    if (tile.v[k] == kWholeTile) sides[k] |= side_bit(kNorth);
  }
  return sides;
}

/// Numbers vertices; if positions are exact, vertices at the same position share a number.
std::vector<std::uint32_t> number_places(const ClientTile& tile) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    numbers.push_back(tile.format == TileFormat::kGlb
                          ? static_cast<std::uint32_t>(k)
                          : static_cast<std::uint32_t>(tile.u[k]) << 16 | static_cast<std::uint32_t>(tile.v[k]));
  }
  return numbers;
}

constexpr double kAlmostPole = 89.9999;

double latitude(const ClientTile& tile, std::uint32_t vertex) {
  return geographic_at(tile.box, tile.u[vertex], tile.v[vertex], 0).latitude;
}

/// True if a triangle certainly faces down, given the precision of positions.
bool faces_down(const ClientTile& tile, std::size_t k) {
  const std::uint32_t a = tile.triangles[k], b = tile.triangles[k + 1], c = tile.triangles[k + 2];
  if (tile.format != TileFormat::kGlb)
    return (tile.u[b] - tile.u[a]) * (tile.v[c] - tile.v[a]) <= (tile.u[c] - tile.u[a]) * (tile.v[b] - tile.v[a]);
  // The test is on the map: a needle along a parallel may face down in space, where its long side is straight.
  const Place ab = tile.places[b] - tile.places[a], ac = tile.places[c] - tile.places[a];
  const double longest = std::max({length(ab), length(ac), length(ac - ab)});
  const auto is_turned = [&](double area) { return area < -3 * tile.resolution * longest; };
  if (tile.is_flat) return is_turned(ab[0] * ac[1] - ac[0] * ab[1]);
  const double polar =
      std::max({std::abs(latitude(tile, a)), std::abs(latitude(tile, b)), std::abs(latitude(tile, c))});
  if (polar > kAlmostPole) return false;  // all longitudes
  constexpr double kMetresOfDegree = 111320;
  const double east = (tile.box.east - tile.box.west) / kWholeTile * kMetresOfDegree *
                      std::cos(latitude(tile, a) * 0.017453292519943295),
               north = (tile.box.north - tile.box.south) / kWholeTile * kMetresOfDegree;
  const double area =
      ((tile.u[b] - tile.u[a]) * (tile.v[c] - tile.v[a]) - (tile.u[c] - tile.u[a]) * (tile.v[b] - tile.v[a])) * east *
      north;
  // Rounding moves each of the three corners by up to √3/2 steps, which may turn a needle over.
  return is_turned(area);
}

/// True if the list of an edge is clockwise around the tile, as clients expect; positions are precise to their format's
/// step.
bool is_clockwise(const ClientTile& tile, std::size_t side) {
  const std::vector<std::uint32_t>& listed = tile.edges[side];
  const std::vector<double>& along = side == kWest || side == kEast ? tile.v : tile.u;
  const double sign = side == kWest || side == kNorth ? 1 : -1;
  // An edge at a pole has neither length nor order.
  const double metres = length(tile.places[listed.back()] - tile.places[listed.front()]);
  const double slack = 3 * tile.resolution / metres * kWholeTile;
  for (std::size_t k = 1; k < listed.size(); ++k) {
    if (sign * (along[listed[k]] - along[listed[k - 1]]) < -slack) return false;
  }
  return true;
}

std::string describe_place(const ClientTile& tile, std::uint32_t vertex) {
  return fmt::format("u {:.6g}, v {:.6g}", tile.u[vertex], tile.v[vertex]);
}

}  // namespace

void check_coverage(const ClientTile& tile, std::vector<TileFault>& faults) {
  const std::string name = tile_name(tile.format, tile.id);
  const auto add = [&](const std::string& what) {
    faults.push_back({TileFaultKind::kCoverage, fmt::format("{} {}", name, what)});
  };
  if (tile.triangles.empty()) return add("has no triangles");
  std::size_t down = 0, first_down = 0;
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    if (faces_down(tile, k) && down++ == 0) first_down = k;
  }
  if (down > 0)
    add(fmt::format("has a triangle that faces down or has no area, at {}",
                    describe_place(tile, tile.triangles[first_down])));

  const std::vector<std::uint32_t> numbers = number_places(tile);
  const std::vector<unsigned> sides = find_sides(tile);
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>> edges;  // positions, then
                                                                                              // vertices
  std::vector<bool> is_used(tile.u.size());
  for (std::size_t k = 0; k < tile.triangles.size(); ++k) {
    const std::uint32_t from = tile.triangles[k], to = tile.triangles[k % 3 == 2 ? k - 2 : k + 1];
    edges.emplace_back(numbers[from], numbers[to], from, to);
    is_used[from] = true;
  }
  std::sort(edges.begin(), edges.end());
  std::size_t on_outline = 0, twice = 0, open = 0;
  std::uint32_t at_twice = 0, at_open = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto& [place, end, from, to] = edges[k];
    if (k > 0 && std::get<0>(edges[k - 1]) == place && std::get<1>(edges[k - 1]) == end && twice++ == 0)
      at_twice = from;
    const auto reverse = std::lower_bound(edges.begin(), edges.end(), std::tuple{end, place, 0u, 0u});
    if (reverse != edges.end() && std::get<0>(*reverse) == end && std::get<1>(*reverse) == place) continue;
    if ((sides[from] & sides[to]) != 0) {
      ++on_outline;
    } else if (open++ == 0) {
      at_open = from;
    }
  }
  if (twice > 0) add(fmt::format("has two triangles on one side of an edge, at {}", describe_place(tile, at_twice)));
  if (open > 0)
    add(fmt::format("has a gap or a vertex in the middle of an edge, at {}", describe_place(tile, at_open)));
  const auto unused = std::find(is_used.begin(), is_used.end(), false);
  if (unused != is_used.end())
    add(fmt::format("has a vertex without a triangle, at {}",
                    describe_place(tile, static_cast<std::uint32_t>(unused - is_used.begin()))));

  if (tile.format == TileFormat::kGlb) {
    std::size_t listed = 0;
    for (const auto& edge : tile.edges) listed += edge.empty() ? 0 : edge.size() - 1;
    if (open == 0 && on_outline != listed)
      add(fmt::format("has {} edges on its outline where its lists have {}", on_outline, listed));
    return;
  }
  std::vector<std::pair<std::uint32_t, double>> heights;
  for (std::size_t k = 0; k < numbers.size(); ++k) heights.emplace_back(numbers[k], tile.heights[k]);
  std::sort(heights.begin(), heights.end());
  const auto wall = std::adjacent_find(heights.begin(), heights.end(), [](const auto& a, const auto& b) {
    return a.first == b.first && a.second != b.second;
  });
  if (wall != heights.end())
    add(fmt::format("has two heights at one place, u {}, v {}", wall->first >> 16, wall->first & 0xffff));
  // Sums of integers below 2^53 are exact.
  double area = 0;
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    const std::uint32_t a = tile.triangles[k], b = tile.triangles[k + 1], c = tile.triangles[k + 2];
    area += (tile.u[b] - tile.u[a]) * (tile.v[c] - tile.v[a]) - (tile.u[c] - tile.u[a]) * (tile.v[b] - tile.v[a]);
  }
  const double whole = 2 * kWholeTile * kWholeTile;
  if (area != whole) add(fmt::format("covers {:.9g} times its area", area / whole));
}

void check_land(const ClientTile& tile, const TileGrid& grid, std::vector<TileFault>& faults) {
  // Above the blocks, tiles end at one of 256 nodes: the raster's end, or the next node beyond it.
  constexpr double kCoarseSteps = 256;
  const LocalRaster& raster = grid.local;
  const double beyond = std::max(0.0, (tile.box.east - tile.box.west) / kCoarseSteps - 1);
  const double cols = std::min(tile.box.east, raster.cols - 1.0) - tile.box.west,
               rows = std::min(tile.box.north, raster.rows - 1.0) - tile.box.south;
  const double width = cols * raster.cell_x, height = rows * raster.cell_y;
  const double more_x = std::max(0.0, std::min(cols + beyond, tile.box.east - tile.box.west) - cols) * raster.cell_x,
               more_y = std::max(0.0, std::min(rows + beyond, tile.box.north - tile.box.south) - rows) * raster.cell_y;
  double area = 0;
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    const Place ab = tile.places[tile.triangles[k + 1]] - tile.places[tile.triangles[k]];
    const Place ac = tile.places[tile.triangles[k + 2]] - tile.places[tile.triangles[k]];
    area += (ab[0] * ac[1] - ac[0] * ab[1]) / 2;
  }
  const double slack = 2 * tile.resolution * (width + height + more_x + more_y);
  const double most = (width + more_x) * (height + more_y);
  if (area < width * height - slack || area > most + slack)
    faults.push_back({TileFaultKind::kCoverage, fmt::format("{} covers {:.9g} times its part of the raster",
                                                            tile_name(tile.format, tile.id), area / (width * height))});
}

void check_edge_lists(const ClientTile& tile, std::vector<TileFault>& faults) {
  constexpr const char* kNames[] = {"western", "southern", "eastern", "northern"};
  constexpr const char* kBackwards[] = {"does not go from south to north", "does not go from east to west",
                                        "does not go from north to south", "does not go from west to east"};
  const auto add = [&](std::size_t side, const char* what) {
    faults.push_back({TileFaultKind::kEdgeList, fmt::format("{}: the list of its {} edge {}",
                                                            tile_name(tile.format, tile.id), kNames[side], what)});
  };
  const std::vector<unsigned> sides = find_sides(tile);
  for (std::size_t side = 0; side < tile.edges.size(); ++side) {
    std::vector<std::uint32_t> listed = tile.edges[side];
    std::sort(listed.begin(), listed.end());
    if (std::adjacent_find(listed.begin(), listed.end()) != listed.end()) {
      add(side, "names a vertex twice");
      continue;
    }
    if (listed.size() < 2) {
      add(side, "has less than two vertices");
      continue;
    }
    std::vector<std::uint32_t> there;
    for (std::uint32_t v = 0; v < sides.size(); ++v) {
      if ((sides[v] & side_bit(side)) != 0) there.push_back(v);
    }
    if (!std::includes(listed.begin(), listed.end(), there.begin(), there.end())) {
      add(side, "leaves out a vertex");
    } else if (listed != there) {
      add(side, "names a vertex that is not there");
    } else if (tile.format == TileFormat::kGlb && !is_clockwise(tile, side)) {
      add(side, kBackwards[side]);
    }
  }
}

}  // namespace scarp::check
