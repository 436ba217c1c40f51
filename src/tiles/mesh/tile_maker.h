// Makes a tile from nodes in memory.
#pragma once

#include <functional>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp::tiles {

/// An upper bound of |mesh − node| over a tile, for the mesh that clients decode.
struct TileVerdict {
  double error = 0;
  std::vector<SampleAt> offenders;    ///< nodes that break the tile's max error; empty if unknown
  double sample_error = 0;            ///< like `error`, for samples if they are bounded; else 0
  std::vector<SampleAt> beside = {};  ///< nodes next to samples that break the max error
};
using TileJudge = std::function<Result<TileVerdict>(const TerrainTile& tile)>;
/// Sets the remaining properties of a tile.
using TileCompletion = std::function<Result<void>(TerrainTile& tile)>;
struct TileProof {
  TileJudge judge;
  TileCompletion complete;
};

/// The errors at the nodes themselves. If the grid's rows are uneven, the offenders are the worst nodes of each
/// triangle.
Result<TileVerdict> judge_at_nodes(const TerrainTile& tile, const TileNodes& nodes, const TileGrid& grid);

/// The proof of a tile at or below the plan's block level: at its nodes, and at the samples of its source. Borrows all
/// arguments.
TileProof proof_at_nodes(const PyramidPlan& plan, const TileNodes& nodes, const NodeSource& source);

/// Makes a mesh of the nodes that satisfies the tile's max error if rounded positions allow it, else the mesh with the
/// least error. The tile's max error is that of the level, doubled while the tile exceeds the plan's byte limit and its
/// interior can have fewer vertices. Without an encoder there is no limit. If no node has a height, the tile has the
/// background's height and is judged at fewer nodes; its edges match its neighbours'.
Result<KeptTile> make_tile_of(const PyramidPlan& plan, TileId id, const TileNodes& nodes, const TileProof& proof,
                              const TileEncoder& encode);

}  // namespace scarp::tiles
