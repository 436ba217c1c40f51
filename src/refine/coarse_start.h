// The start of a tile's refinement: two triangles, or the mesh of a coarser raster.
//
// The worst sample of a large triangle is an extreme of the noise as often as a peak of the terrain. On every 8th
// sample the terrain is the same and the noise has 64 times fewer extremes, and a scan costs 64 times less. So where
// the mesh is to be coarse, the subsampled tile is refined first, its vertices are inserted (a sample of the coarse
// raster is one of the fine one), and refinement continues from there with all samples. On real terrain that gives
// fewer vertices, sooner (bench/performance.md, "Starts"). Where the coarse mesh would need a large part of the coarse
// samples the vertices are too many and at the wrong points; then the tile starts from two triangles.
#pragma once

#include <vector>

#include "refine/tile.h"
#include "refine/tile_scanner.h"
#include "scarp/run.h"
#include "tin/tile_mesh.h"

namespace scarp {

class CoarseStart {
 public:
  /// Inserts into the started `mesh` of a tile what every 8th, or 4th, sample alone would need, where that is few.
  /// `density`: vertices a sample to be expected of the finished mesh; it decides what is tried. On terrain that
  /// `is_rough` more is tried and kept: extremes of noise are many there. A trial that needs too many is broken off: at
  /// most one insertion for each 190 samples of the tile is in vain. No vertex is put on a shared side, or outside the
  /// surface.
  void insert(const Tile& tile, const SharedSides& shared, double threshold, double density, bool is_rough,
              TileMesh& mesh);

  /// Work of the last call.
  const Work& work() const { return work_; }

 private:
  bool refine(const Tile& tile, std::int32_t step, double share, double threshold);

  Tile coarse_;
  TileMesh mesh_;
  std::vector<TilePoint> inserted_;
  Work work_;
};

}  // namespace scarp
