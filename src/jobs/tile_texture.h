// The textures of tiles.
#pragma once

#include <optional>

#include "io/globe_image.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp::jobs {

/// The texture's sides are the smallest 256 · 2^k pixels that reach the image's resolution. The limit is 512 pixels,
/// the largest side on screen before clients load the tile's children, or 2048 for a tile without children. Nothing if
/// the image has no colour there. Fails as GlobeImage::read() and encode_image() do.
Result<std::optional<io::TileTexture>> make_tile_texture(const io::GlobeImage& image, ImageFormat format,
                                                         const PyramidPlan& plan, TileId id);

}  // namespace scarp::jobs

#pragma GCC visibility pop
