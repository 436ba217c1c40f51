// The order that suits a tile, from its terrain.
//
// The lazy order guesses errors from areas (lazy_levels.h). That is a good guess where the terrain is rough: there a
// triangle's error is an extreme of many samples that know little of each other, and grows slowly with its size. Where
// it is smooth one bend fills a triangle, and neighbours must be compared.
//
// The test compares the mean bend (second difference) of samples that lie d apart, with that of samples 2d apart, where
// d is the distance of neighbouring vertices to be expected. On a smooth surface the bend grows 4 times from d to 2d,
// on noise not at all, on real terrain 1.1 to 3 times.
#pragma once

#include "geom/tile_view.h"

namespace scarp {

enum class TileOrder { kDominant, kLazyHalf, kLazyOne };

/// A function of the tile's samples and of `density`, the vertices a sample to be expected, alone.
TileOrder choose_order(const TileView& tile, double density);

}  // namespace scarp
