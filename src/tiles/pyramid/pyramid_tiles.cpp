#include "tiles/pyramid/pyramid_tiles.h"

#include <algorithm>

#include "scarp/tile.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/mesh/tile_mesh_parts.h"

namespace scarp {
namespace {

bool overlap(const PyramidPlan& plan, const DegreeBox& box, const DegreeBox& covered, double more) {
  if (box.south > covered.north + more || box.north < covered.south - more) return false;
  for (const double turn : plan.grid.turns()) {
    if (box.west + turn <= covered.east + more && box.east + turn >= covered.west - more) return true;
  }
  return false;
}

/// The position of a tile on Hilbert curves through the roots, each from its south-western to its south-eastern corner.
std::uint64_t place_on_curve(TileId id) {
  const std::uint32_t last = (std::uint32_t{1} << id.z) - 1;
  std::uint32_t x = id.x & last, y = id.y;
  std::uint64_t place = id.x >> id.z;
  for (int bit = id.z - 1; bit >= 0; --bit) {
    const std::uint32_t right = (x >> bit) & 1, up = (y >> bit) & 1;
    place = place << 2 | ((3 * right) ^ up);
    if (up != 0) continue;
    if (right != 0) {
      x = last - x;
      y = last - y;
    }
    std::swap(x, y);
  }
  return place;
}

}  // namespace

int finest_level(const PyramidPlan& plan, TileId id) {
  // A margin on each side: heights on a border, or within the reach of normals, count on both sides of the border.
  const double node = (tiles::normal_reach(tiles::steps_of(plan, plan.block_level)) + 1) *
                      plan.grid.largest_step(plan.grid.per_turn(plan.max_zoom(), plan.cells));
  const DegreeBox box = plan.grid.bounds_of(id);
  if (plan.sources.empty()) return overlap(plan, box, plan.covered, node) ? plan.max_zoom() : -1;
  int finest = -1;
  for (const PlannedSource& source : plan.sources) {
    if (source.max_zoom > finest && overlap(plan, box, source.covered, node)) finest = source.max_zoom;
  }
  return finest;
}

bool tiles::is_covered(const PyramidPlan& plan, TileId id) { return plan.grid.has(id) && finest_level(plan, id) >= 0; }

bool tiles::is_wanted(const PyramidPlan& plan, TileId id) {
  if (!plan.grid.has(id)) return false;
  if (id.z <= plan.block_level || plan.sources.empty()) return true;
  if (!plan.has_siblings) return finest_level(plan, id) >= id.z;
  const std::array<TileId, 4> siblings = children_of({id.z - 1, id.x / 2, id.y / 2});
  return std::any_of(siblings.begin(), siblings.end(), [&](TileId one) { return finest_level(plan, one) >= id.z; });
}

std::array<TileId, 4> tiles::children_of(TileId id) {
  const int z = id.z + 1;
  return {{{z, 2 * id.x, 2 * id.y},
           {z, 2 * id.x + 1, 2 * id.y},
           {z, 2 * id.x, 2 * id.y + 1},
           {z, 2 * id.x + 1, 2 * id.y + 1}}};
}

std::vector<tiles::TileSet> tiles::choose_tiles(const PyramidPlan& plan) {
  std::vector<TileSet> chosen(1);
  for (std::uint32_t x = 0; x < plan.grid.roots(); ++x) chosen.front().insert({0, x});
  for (int z = 1; z <= plan.block_level; ++z) {
    TileSet level;
    for (const auto& [y, x] : chosen.back()) {
      const std::array<TileId, 4> children = children_of({z - 1, x, y});
      if (std::none_of(children.begin(), children.end(), [&](TileId id) { return is_covered(plan, id); })) continue;
      for (const TileId child : children) {
        if (plan.grid.has(child)) level.insert({child.y, child.x});
      }
    }
    chosen.push_back(std::move(level));
  }
  return chosen;
}

std::uint64_t block_cost(const PyramidPlan& plan, TileId block) {
  const DegreeBox box = plan.grid.bounds_of(block), &covered = plan.covered;
  const double width = box.east - box.west, height = box.north - box.south;
  const double down = std::min(box.north, covered.north) - std::max(box.south, covered.south);
  double across = 0;
  for (const double turn : plan.grid.turns())
    across += std::max(0.0, std::min(box.east + turn, covered.east) - std::max(box.west + turn, covered.west));
  return 1 + static_cast<std::uint64_t>(1000 * std::max(0.0, down) * std::min(across, width) / (width * height));
}

std::vector<TileId> find_blocks(const PyramidPlan& plan) {
  std::vector<TileId> blocks;
  const std::vector<tiles::TileSet> chosen = tiles::choose_tiles(plan);
  for (const auto& [y, x] : chosen.back()) blocks.push_back({plan.block_level, x, y});
  std::sort(blocks.begin(), blocks.end(), [](TileId a, TileId b) { return place_on_curve(a) < place_on_curve(b); });
  return blocks;
}

}  // namespace scarp
