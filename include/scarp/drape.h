// Images draped over a raster.
#pragma once

#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

/// An image on the place of a raster: its corners are those of the raster's image, as Mesh::uvs count.
struct Drape {
  Picture picture;
  double covered = 1;                 ///< share of the pixels that the file has a colour for; the others are white
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// Reads an image of 8 bits (grey, a palette, or red green blue; alpha 0 and nodata are no colour) and resamples it,
/// bilinearly, onto the raster's image, whatever its own CRS and grid; `size`: pixels on the longer side, 0: one for
/// each pixel of the file that lies on the raster, at most 8192. An image without georeference is stretched over a
/// raster that has none, and over any raster of as many samples as it has pixels, with a warning. By GDAL. Fails with
/// kInput: no such file, not of 8 bits, one of the two without a place, not on the raster, a CRS that cannot be
/// reached.
Result<Drape> read_drape(const std::string& path, const RasterInfo& raster, int cols, int rows, int size = 0,
                         const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
