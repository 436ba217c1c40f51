// Plan a pyramid of terrain tiles on the globe and make its tiles, as meshes and as bytes of quantized-mesh. For sets
// of tiles, made of raster files, see tile_job.h.
//
// The grid (TileGrid) lists the tiles. A tile is a function of (its id, the plan, the heights of its nodes and a few
// nodes around it). No neighbour enters it, so tiles may be made in any order, on any machine; two neighbours still
// have the same vertices, heights and normals on the edge that they share.
//
// NODES. The source is sampled on a lattice: `cells` cells a side for tiles of the finest level. Coarser tiles use all
// nodes below them, down to the plan's level of blocks. The max error of a tile counts all of them.
//
// A LOCAL GRID lies on a plane, its nodes are the samples of one raster, and tiles end where that does. All terms for
// the earth's curve are 0 there.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif", {.crs = "source"}));  // in degrees
//     SCARP_TRY(const auto& box, scarp::degrees_covered(dem, dem.frame.affine, nullptr));
//     const scarp::SourceFacts facts{.covered = box, .cell = 80, .min = dem.info.min, .max = dem.info.max};
//     SCARP_TRY(const auto& plan, scarp::plan_pyramid(facts, {.cells = 16}));
//     SCARP_TRY(const auto& nodes, scarp::make_node_source(dem, {.affine = dem.frame.affine}));
//     SCARP_TRY(const auto& tile, scarp::make_tile(plan, scarp::find_blocks(plan).front(), *nodes));
//     SCARP_RETURN_IF_ERROR(scarp::write_file("block.terrain", scarp::encode_quantized_mesh(tile)));
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/nodes.h"
#include "scarp/pyramid.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile_grid.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The facts about the source that a plan needs.
struct SourceFacts {
  DegreeBox covered = {};
  double cell = 0;          ///< metres along the ground, the geometric mean of both ways, above 0
  double min = 0, max = 0;  ///< bounds of its heights, metres
  double cell_degrees = 0;  ///< like `cell`, for a raster in degrees; 0 for others
};

/// The conflicts among the settings, each a sentence: plan_pyramid() fails with kUsage and the first. Empty: none.
std::vector<std::string> list_conflicts(const PyramidSettings& settings);

/// Fails with kUsage for settings out of range.
Result<PyramidPlan> plan_pyramid(const SourceFacts& source, const PyramidSettings& settings = {});
/// Plans for a stack of at least one source: the finest level is that of the source that asks for the finest, and so
/// are the nodes everywhere.
Result<PyramidPlan> plan_pyramid(std::span<const SourceFacts> stack, const PyramidSettings& settings = {});

/// Gives the plan lines in place of those that it has; for its levels, and what is covered.
void set_lines(PyramidPlan& plan, std::vector<DegreeLine> lines);

/// The finest level that a source asks for in a tile, or so near that the tile's normals reach it; −1 where none has
/// heights there.
int finest_level(const PyramidPlan& plan, TileId id);

/// The tile as a set keeps it, within plan.max_tile_bytes where that can be: a function of (id, plan, nodes, encoder).
///
/// At plan.block_level and below, its node_error is at most its max error, but where positions in 32767ths of the tile
/// cannot follow the land, next to a cliff; its source_error too, if the plan binds samples, but where these are too
/// far from the land between the nodes around them.
///
/// Above plan.block_level it is made of the nodes that its mesh needs and no others: the mesh of finish_pyramid(), but
/// without its proof. node_error is NaN, since no nodes between these were examined. Cost: some 70,000 nodes, each read
/// alone where they are far apart.
///
/// REQUIRES: 0 <= id.z <= plan.max_zoom(). Fails as the source and the encoder do.
Result<KeptTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source, const TileEncoder& encode);
/// The tile, of as many bytes as it needs.
Result<TerrainTile> make_tile(const PyramidPlan& plan, TileId id, const NodeSource& source);

/// The tiles of make_pyramid(), without making one: by level, rows and columns, y · 2^32 + x, sorted. Reads each node
/// once; without a source no node, and then tiles below the blocks count as soon as the plan's source may cover them.
/// Progress: pass "look". Fails as the source does, and with kCancelled.
Result<std::vector<std::vector<std::uint64_t>>> find_tiles(const PyramidPlan& plan, const NodeSource* source,
                                                           const Run& run = {});

/// The blocks of a pyramid: its tiles of plan.block_level, along Hilbert's curve, so that neighbours in the list are
/// neighbours on the globe. All tiles below a block are made with it; any process may make any block.
std::vector<TileId> find_blocks(const PyramidPlan& plan);

/// Relative cost of a block, about: 1, and 1000 times the share of it that the source may cover.
std::uint64_t block_cost(const PyramidPlan& plan, TileId block);

/// Makes the tiles of one block that have heights, their siblings if the plan wants them, and the block's own in any
/// case. A tile's bytes are those of make_tile(). Tiles of levels below `deepest` are omitted, and their errors from
/// the report; all else is that of the whole block. REQUIRES: find_blocks() names the block.
///
/// Cost: each node is read once; memory: that of its nodes, 4 · (32 · cells)² bytes. Progress: pass "tiles". Fails as
/// make_tile() and the sink do, and with kCancelled.
Result<BlockReport> make_block(const PyramidPlan& plan, TileId block, const NodeSource& source, TileSink& sink,
                               const Run& run = {}, int deepest = std::numeric_limits<int>::max());

/// A hash of all that make_block() reads from the source, nodes and samples, and of the shapes of water masks: blocks
/// of one hash and one plan have the same tiles and errors. 0 for a block without heights and masks. Cost: the nodes
/// are read; memory as make_block(). Fails as the source does.
Result<std::uint64_t> hash_block(const PyramidPlan& plan, TileId block, const NodeSource& source, int threads = 0);

/// Makes the tiles above the blocks, of nodes reduced to 256 cells a side. Their node_error is an upper bound for all
/// nodes below, which the reduction carries upwards. REQUIRES: `blocks` are those of find_blocks(), in any order.
/// Returns what is known of all tiles. Progress and failures as make_block(), and kInput for damaged `reduced`.
Result<PyramidReport> finish_pyramid(const PyramidPlan& plan, std::vector<BlockReport> blocks, TileSink& sink,
                                     const Run& run = {});

/// Makes all tiles of a pyramid: those with heights; of levels up to plan.block_level also the others that clients need
/// to reach them: all roots, and the siblings of each tile. The same as make_block() for each of find_blocks() in
/// their order, and then finish_pyramid().
Result<PyramidReport> make_pyramid(const PyramidPlan& plan, const NodeSource& source, TileSink& sink,
                                   const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
