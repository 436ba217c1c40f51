#include "refine/coarse_start.h"

#include <algorithm>

#include "refine/dominant.h"
#include "refine/tile_domain.h"

namespace scarp::refine {

namespace {

struct Attempt {
  std::int32_t step;
  double expected;  ///< tried if at most this share of the coarse samples is expected to be needed
  double most;      ///< kept if at most this share is needed
};
constexpr Attempt kAttempts[] = {{8, 0.12, 0.08}, {4, 0.08, 0.03}};
constexpr Attempt kRoughAttempts[] = {{8, 0.25, 0.12}, {4, 0.08, 0.06}};

}  // namespace

void CoarseStart::insert(const Tile& tile, const SharedSides& shared, double threshold, double density, bool is_rough,
                         tin::TileMesh& mesh) {
  work_ = {};
  const std::int32_t last_col = tile.view().cols - 1, last_row = tile.view().rows - 1;
  for (const Attempt& attempt : is_rough ? kRoughAttempts : kAttempts) {
    const std::int32_t step = attempt.step;
    // Fewer than some 16 coarse samples per side show nothing about the terrain.
    if (density * step * step > attempt.expected || std::min(last_col, last_row) < 16 * step) continue;
    if (!refine(tile, step, attempt.most, threshold)) continue;
    tin::TileMesh::Id last = 0;
    for (const geom::TilePoint p : inserted_) {
      const std::int32_t x = geom::tile_x(p) * step, y = geom::tile_y(p) * step;
      const bool is_shared = (shared.left && x == 0) || (shared.top && y == 0) || (shared.right && x == last_col) ||
                             (shared.bottom && y == last_row);
      if (is_shared) continue;
      last = mesh.locate(geom::tile_point(x, y), last);
      if (!mesh.is_outside(last)) last = mesh.insert(geom::tile_point(x, y), last);
    }
    return;
  }
}

bool CoarseStart::refine(const Tile& tile, std::int32_t step, double share, double threshold) {
  coarse_.load_coarse(tile, step);
  const geom::TileView& view = coarse_.view();
  if (!start_tile(coarse_, {}, mesh_)) return false;
  inserted_.clear();
  TileScanner scanner(view, threshold);
  const auto most = static_cast<std::size_t>(share * view.cols * view.rows);
  const DominantRun run = refine_dominant(mesh_, scanner, most, &inserted_);
  work_.samples_scanned += scanner.samples_scanned();
  work_.triangles_scanned += scanner.triangles_scanned();
  work_.queue_moves += run.moves;
  return run.finished;
}

}  // namespace scarp::refine
