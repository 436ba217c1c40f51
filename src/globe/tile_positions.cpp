#include "globe/tile_positions.h"

namespace scarp::globe {
namespace {

struct Degrees {
  double longitude = 0, latitude = 0;
};

Degrees degrees_at(const DegreeBox& box, double u, double v, double units) {
  return {box.west + (box.east - box.west) * (u / units), box.south + (box.north - box.south) * (v / units)};
}

}  // namespace

std::vector<Space> positions_in_space(const TerrainTile& tile, const TileGrid& grid, const Ground& ground) {
  const DegreeBox box = grid.bounds_of(tile.id);
  std::vector<Space> positions;
  for (std::size_t k = 0; k < tile.u.size(); ++k) {
    const Degrees at = degrees_at(box, tile.u[k], tile.v[k], tile.units);
    positions.push_back(ground.position(at.longitude, at.latitude, tile.quantum * tile.heights[k]));
  }
  return positions;
}

}  // namespace scarp::globe
