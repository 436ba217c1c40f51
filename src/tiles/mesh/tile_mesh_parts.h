// The parts of a tile's mesh besides its vertices: normals, sag, and positions for the judge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "globe/ground.h"
#include "scarp/mesh.h"
#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/mesh/tile_rows.h"

namespace scarp::tiles {

/// The node nearest to a place of 0 … `units` on a side of `steps` steps.
inline std::int32_t nearest_node(std::uint16_t place, std::int32_t steps, std::int32_t units) {
  return static_cast<std::int32_t>((std::int64_t{place} * steps * 2 + units) / (2 * std::int64_t{units}));
}

/// Number of nodes on either side that affect a normal: 1/256 of the tile, at least one.
std::int32_t normal_reach(std::int32_t steps);

/// Normals from central differences at the node nearest to each vertex. They depend only on node and level, so adjacent
/// tiles agree. At a pole the normal points away from the earth.
std::vector<std::array<std::uint8_t, 2>> node_normals(const TerrainTile& tile, const TileNodes& nodes,
                                                      const TileRows& rows, const TileGrid& grid,
                                                      const globe::Ground& ground);

/// The largest height of the curved ground above flat triangles: r² / 2R, where r is the radius of a triangle's
/// smallest enclosing circle and R is the smallest radius of curvature.
double largest_sag(const TerrainTile& tile, const TileGrid& grid, const globe::Ground& ground);

/// The mesh that clients decode, with x and y in steps from the south-western node, and heights in metres as float32.
Mesh decoded(const TerrainTile& tile, std::int32_t steps);

}  // namespace scarp::tiles
