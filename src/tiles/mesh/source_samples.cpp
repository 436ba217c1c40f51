#include "tiles/mesh/source_samples.h"

#include <cmath>

#include "tiles/mesh/tile_rows.h"

namespace scarp::tiles {

Result<SampleVerdict> judge_at_samples(const TerrainTile& tile, const TileGrid& grid, const TileNodes& nodes,
                                       const NodeSource& source, double limit) {
  if (!source.has_samples()) return SampleVerdict{std::numeric_limits<double>::quiet_NaN(), {}};
  const DegreeBox box = grid.bounds_of(tile.id);
  const double units = tile.units, per_u = units / (box.east - box.west), per_v = units / (box.north - box.south);
  TileSurface::Counts counts;
  const TileRows rows(grid, tile.id, nodes.steps());
  if (nodes.has_voids()) {
    counts = [&](double u, double v) {
      return nodes.has_heights_around(u / units * nodes.steps(), rows.above((1 - v / units) * nodes.steps()));
    };
  }
  TileSurface surface(tile, limit, counts);
  auto visited = source.visit_samples(box, [&](const SampleRow& row) {
    surface.judge({(row.longitude - box.west) * per_u, (row.latitude - box.south) * per_v, row.step_longitude * per_u,
                   row.step_latitude * per_v, row.heights});
  });
  SCARP_RETURN_IF_ERROR(visited);
  return SampleVerdict{surface.largest_error(), surface.far_points()};
}

}  // namespace scarp::tiles
