// The start of a tile's refinement: two triangles, or the mesh of a coarser raster.
//
// The worst sample of a large triangle is an extreme of the noise as often as a peak of the terrain. If only every 8th
// sample is used, the terrain is the same, but the noise has 64 times fewer extremes, and a scan costs 64 times less.
// So for a coarse mesh, the subsampled tile is refined first, its vertices are inserted (each coarse sample is a sample
// of the tile), and refinement continues with all samples. On real terrain the result has fewer vertices and needs less
// time (bench/performance.md, "Starts"). A coarse mesh that needs a large part of the coarse samples has too many
// vertices at wrong points. Then the tile starts from two triangles.
#pragma once

#include <vector>

#include "refine/tile.h"
#include "refine/tile_scanner.h"
#include "scarp/run.h"
#include "tin/tile_mesh.h"

namespace scarp::refine {

class CoarseStart {
 public:
  /// Inserts into the started `mesh` of a tile the vertices that every 8th, or 4th, sample needs, if they are few.
  /// `density`: vertices per sample expected in the finished mesh; it decides what is tried. If `is_rough`, more is
  /// tried and kept, because rough terrain has many extremes of noise. A trial that needs too many vertices is stopped:
  /// at most one insertion per 190 samples of the tile is wasted. Inserts no vertex on a shared side or outside the
  /// surface.
  void insert(const Tile& tile, const SharedSides& shared, double threshold, double density, bool is_rough,
              tin::TileMesh& mesh);

  /// Work of the last call.
  const Work& work() const { return work_; }

 private:
  bool refine(const Tile& tile, std::int32_t step, double share, double threshold);

  Tile coarse_;
  tin::TileMesh mesh_;
  std::vector<geom::TilePoint> inserted_;
  Work work_;
};

}  // namespace scarp::refine
