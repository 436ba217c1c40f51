// A tile from nodes that are at hand.
#pragma once

#include <functional>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp {

/// A bound of the largest |mesh − node| of a tile, of the mesh that clients decode.
struct TileVerdict {
  double error = 0;
  std::vector<SampleAt> offenders;    ///< nodes that break the tile's max error; empty where they are not known
  double sample_error = 0;            ///< like `error`, for samples, where they are bound; else 0
  std::vector<SampleAt> beside = {};  ///< nodes next to samples that break it
};
using TileJudge = std::function<Result<TileVerdict>(const TerrainTile& tile)>;
/// Sets what else is known of a tile.
using TileCompletion = std::function<Result<void>(TerrainTile& tile)>;
struct TileProof {
  TileJudge judge;
  TileCompletion complete;
};

/// The errors at the nodes themselves. Where the grid's rows are not even the offenders are the worst of each triangle.
Result<TileVerdict> judge_at_nodes(const TerrainTile& tile, const TileNodes& nodes, const TileGrid& grid);

/// The proof of a tile at or below the plan's block level: at its nodes, and at the samples of its source. Borrows all.
TileProof proof_at_nodes(const PyramidPlan& plan, const TileNodes& nodes, const NodeSource& source);

/// A mesh of the nodes that satisfies the tile's max error where rounded positions can, else the one with the least.
/// That max error is the level's, doubled while the tile's bytes are more than the plan's limit and its interior can
/// have fewer vertices. Without an encoder there are no bytes and no limit. Nodes without a height become a tile of the
/// background, judged at fewer of them: the same on its edges as its neighbours.
Result<KeptTile> make_tile_of(const PyramidPlan& plan, TileId id, const TileNodes& nodes, const TileProof& proof,
                              const TileEncoder& encode);

}  // namespace scarp
