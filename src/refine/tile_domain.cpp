#include "refine/tile_domain.h"

#include <algorithm>
#include <vector>

#include "refine/domain.h"

namespace scarp::refine {

Result<void> start_tile(const Tile& tile, std::span<const geom::TilePoint> border, tin::TileMesh& mesh) {
  const geom::TileView& view = tile.view();
  if (tile.is_whole()) {
    mesh.reset(view.cols, view.rows);
    tin::TileMesh::Id last = 0;
    for (const geom::TilePoint p : border) last = mesh.insert(p, last);
    return {};
  }
  std::vector<float> samples;
  samples.reserve(static_cast<std::size_t>(view.cols) * static_cast<std::size_t>(view.rows));
  for (std::int32_t y = 0; y < view.rows; ++y) samples.insert(samples.end(), view.row(y), view.row(y) + view.cols);
  const grid::Raster raster{samples.data(), view.cols, view.rows};
  tin::Triangulation tin(view.cols, view.rows);
  if (auto domain = build_domain(raster, 0, Frame{})) {
    tin = std::move(domain->tin);
  } else if (domain.error().kind == ErrorKind::kInput) {  // no cell is surface
    for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) tin.set_outside(t, true);
  } else {
    return tl::unexpected(domain.error());
  }
  for (const geom::TilePoint p : border)
    tin.insert(geom::point_of(p), tin.locate(geom::point_of(p), tin.last_touched()));
  mesh.assign(tin);
  return {};
}

}  // namespace scarp::refine
