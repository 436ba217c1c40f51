// A tile's skirt hangs from its edges to hide gaps next to tiles of other levels. The skirt is correct if its upper
// sides are the steps of whole edges, each once and clockwise, and each lower vertex lies below its upper one.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "check/tile_faults.h"

namespace scarp::check {
namespace {

/// Two successive vertices of an edge, clockwise around the tile.
using SkirtStep = std::pair<Place, Place>;

/// Even vertices are the upper ones.
std::vector<SkirtStep> find_upper_sides(const ClientTile& tile) {
  std::vector<SkirtStep> steps;
  for (std::size_t k = 0; k < tile.skirt_triangles.size(); ++k) {
    const std::uint32_t from = tile.skirt_triangles[k], to = tile.skirt_triangles[k % 3 == 2 ? k - 2 : k + 1];
    if (from % 2 == 0 && to % 2 == 0) steps.emplace_back(tile.skirt[from], tile.skirt[to]);
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

bool hangs_down(const ClientTile& tile, const World& world) {
  if (tile.skirt.size() % 2 != 0) return false;
  for (std::size_t k = 0; k < tile.skirt.size(); k += 2) {
    if (!(world.find(tile.skirt[k + 1]).height < world.find(tile.skirt[k]).height - tile.resolution)) return false;
  }
  return true;
}

}  // namespace

void check_skirt(const ClientTile& tile, const World& world, std::vector<TileFault>& faults) {
  const auto add = [&](const char* what) {
    faults.push_back({TileFaultKind::kBorder, fmt::format("{}: its skirt {}", tile_name(tile.format, tile.id), what)});
  };
  if (tile.skirt.empty()) return;
  if (!hangs_down(tile, world)) return add("does not hang down");
  const std::vector<SkirtStep> there = find_upper_sides(tile);
  std::size_t of_edges = 0;
  for (const std::vector<std::uint32_t>& edge : tile.edges) {
    std::size_t found = 0;
    for (std::size_t k = 1; k < edge.size(); ++k) {
      const SkirtStep step{tile.places[edge[k - 1]], tile.places[edge[k]]};
      found += std::binary_search(there.begin(), there.end(), step);
    }
    if (found > 0 && found + 1 < edge.size()) return add("leaves out a part of an edge");
    of_edges += found;
  }
  if (of_edges < there.size()) add("hangs from elsewhere than the edges, or faces the tile");
}

}  // namespace scarp::check
