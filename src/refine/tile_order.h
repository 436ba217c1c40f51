// Chooses the order of insertion that suits the terrain of a tile.
//
// The lazy order estimates errors from areas (lazy_levels.h). The estimate is good on rough terrain, where a triangle's
// error is an extreme of many nearly independent samples and grows slowly with its size. On smooth terrain, one bend
// fills a triangle, and neighbours must be compared.
//
// The test compares the mean bend (second difference) of samples d apart with that of samples 2d apart, where d is the
// expected distance of neighbouring vertices. From d to 2d, the bend grows 4 times on a smooth surface, not at all on
// noise, and 1.1 to 3 times on real terrain.
#pragma once

#include "geom/tile_view.h"

namespace scarp::refine {

enum class TileOrder { kDominant, kLazyHalf, kLazyOne };

/// Depends only on the tile's samples and on `density`, the expected vertices per sample.
TileOrder choose_order(const geom::TileView& tile, double density);

}  // namespace scarp::refine
