#include "refine/tile_scanner.h"

#include <algorithm>
#include <limits>

namespace scarp::refine {

TileScanner::TileScanner(const geom::TileView& tile, double threshold, const geom::ScanKernels& kernels)
    : kernels_(kernels),
      tile_(tile),
      threshold_(threshold),
      metric_(grid::Raster{tile.samples, static_cast<std::int32_t>(tile.stride), tile.rows}, threshold) {}

void TileScanner::scan(tin::TileMesh& mesh, std::span<const tin::TileMesh::Id> triangles,
                       std::span<const geom::TilePoint> hints) {
  corners_.clear();
  ids_.clear();
  for (const tin::TileMesh::Id t : triangles) {
    if (mesh.is_outside(t)) continue;
    ids_.push_back(t);
    corners_.push_back(mesh[t].corners);
  }
  hits_.resize(ids_.size());
  samples_ += kernels_.scan(tile_, threshold_, corners_, hints, hits_.data());
  triangles_ += ids_.size();
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    tin::TileMesh::Record& record = mesh[ids_[i]];
    const geom::ScanHit& hit = hits_[i];
    record.key = candidate_key(hit.error, hit.at);
    const bool is_certain = double{hit.error} > threshold_ + double{hit.guard};
    // If the guard is wider than the threshold, an error computed as 0 may break the bound.
    const bool is_in_doubt = hit.error > 0 || double{hit.guard} > threshold_;
    if (is_in_doubt && !is_certain) settle(record);
  }
}

bool TileScanner::is_on_shared_side(Point p) const {
  return (shared_.left && p.x == 0) || (shared_.top && p.y == 0) || (shared_.right && p.x == tile_.cols - 1) ||
         (shared_.bottom && p.y == tile_.rows - 1);
}

void TileScanner::settle(tin::TileMesh::Record& record) {
  std::array<Point, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = geom::point_of(record.corners[k]);
  record.key = 0;
  if (orient(corners[0], corners[1], corners[2]) == 1) return;  // holds no sample but its corners (Pick)
  const auto candidate = metric_.find_candidate(corners, metric_.fit(corners, {}));
  if (!candidate) return;
  if (is_on_shared_side(candidate->at)) {
    has_given_up_ = true;
    return;
  }
  record.key = candidate_key(std::max(static_cast<float>(candidate->error), std::numeric_limits<float>::min()),
                             geom::tile_point(candidate->at.x, candidate->at.y));
}

}  // namespace scarp::refine
