// The textures of tiles.
#pragma once

#include <optional>

#include "io/globe_image.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

/// 256 · 2^k pixels each way: as many as the image has there, at most 512, which is what clients show of a tile before
/// they load its children, or 2048 where there are none. Nothing where the image has no colour. Fails as
/// GlobeImage::read() and encode_image().
Result<std::optional<TileTexture>> make_tile_texture(const GlobeImage& image, ImageFormat format,
                                                     const PyramidPlan& plan, TileId id);

}  // namespace scarp

#pragma GCC visibility pop
