// Makes a single tile of any level.
#include <cstdint>
#include <limits>
#include <utility>

#include "scarp/tile.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/nodes/decimated_nodes.h"

namespace scarp {
namespace {

/// Accepts the first mesh without folds, whatever its error, since finish_pyramid() has no other.
tiles::TileProof no_proof() {
  return {[](const TerrainTile&) -> Result<tiles::TileVerdict> {
            return tiles::TileVerdict{0, {}};
          },
          [](TerrainTile& tile) -> Result<void> {
            tile.node_error = std::numeric_limits<double>::quiet_NaN();
            return {};
          }};
}

}  // namespace

Result<KeptTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source, const TileEncoder& encode) {
  const bool is_above = id.z < plan.block_level;
  const std::int32_t steps = is_above ? 2 * tiles::kCoarseCells : tiles::steps_of(plan, id.z);
  const tiles::DecimatedNodes few(source, plan.grid.per_turn(plan.max_zoom(), plan.cells));
  const NodeSource& read = is_above ? static_cast<const NodeSource&>(few) : source;
  SCARP_TRY(const auto& nodes, tiles::TileNodes::read(plan, id, steps, tiles::normal_reach(steps), read));
  return tiles::make_tile_of(plan, id, nodes, is_above ? no_proof() : tiles::proof_at_nodes(plan, nodes, source),
                             encode);
}

Result<TerrainTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source) {
  SCARP_TRY(auto&& kept, make_tile(plan, id, source, {}));
  return std::move(kept.tile);
}

}  // namespace scarp
