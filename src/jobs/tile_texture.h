// The textures of tiles.
#pragma once

#include <optional>

#include "io/globe_image.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

/// 256 · 2^k pixels each way: the image's resolution there, up to 512, which clients show until they load the tile's
/// children, or up to 2048 if it has none. Nothing if the image has no colour there. Fails as GlobeImage::read() and
/// encode_image().
Result<std::optional<TileTexture>> make_tile_texture(const GlobeImage& image, ImageFormat format,
                                                     const PyramidPlan& plan, TileId id);

}  // namespace scarp

#pragma GCC visibility pop
