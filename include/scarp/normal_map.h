// The normals of a raster as an image.
#pragma once

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Unit normals of the field's surface, in its frame, as a tangent-space normal map (GlbOptions::normal_map): red x,
/// green y, blue z, each (n + 1) / 2 of 255. Covers the raster's image, `side` pixels on its longer side, at most one a
/// sample; a pixel is the mean of the normals of the samples below it. Nodata is (0, 0, 1). Streamed samples are read
/// once, from the top. Fails as the field's source does, and with kUsage for a side below 1 and a frame in space.
Result<Picture> draw_normal_map(const HeightField& field, int side);

}  // namespace scarp

#pragma GCC visibility pop
