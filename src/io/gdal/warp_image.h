// 8-bit images, warped to a target georeference.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gdal/crs.h"
#include "io/gdal/open.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp::gdal {

using Transform6 = std::array<double, 6>;

/// Side of the square on which image and raster lie if neither has a position. GDAL would interpret pixels of size 1 as
/// a missing position.
constexpr double kNowhere = 0.7;

/// The image with bands red, green, blue, and alpha if present; colours replace palette indices. Unless `located`, the
/// image is placed on that square. Fails with kInput unless the bands have 8 bits.
Result<Dataset> arrange_bands(Session& session, GDALDatasetH image, const std::string& path, bool located);

/// An in-memory picture with a georeference: red, green, blue, alpha. `place`: geotransform of a single pixel that
/// covers the picture.
Dataset make_target(const Transform6& place, const Crs& crs, int width, int height);

/// Warps the image to the target, bilinearly. Fails with kInput, and with kCancelled.
Result<void> warp(Session& session, GDALDatasetH image, GDALDatasetH target, const std::string& path,
                  const ProgressCallback& progress);

struct WarpedPixels {
  Picture picture;
  std::vector<std::uint8_t> alpha;  ///< 0: no colour
};
/// Moves the pixels out of a target. Fails with kInput.
Result<WarpedPixels> take_pixels(Session& session, GDALDatasetH target, const std::string& path);

}  // namespace scarp::gdal
