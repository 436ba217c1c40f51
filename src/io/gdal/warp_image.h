// Images of 8 bits, warped onto a place.
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

/// Side of the square on which image and raster lie where none has a place; pixels of size 1 would mean no place to
/// GDAL.
constexpr double kNowhere = 0.7;

/// The image with bands red, green, blue, and alpha where it has one, colours in place of a palette's numbers;
/// `located`: else it lies on the square. Fails with kInput for what has not 8 bits.
Result<Dataset> arrange_bands(Session& session, GDALDatasetH image, const std::string& path, bool located);

/// A picture in memory on a place: red, green, blue, alpha. `place`: of a picture of one pixel.
Dataset make_target(const Transform6& place, const Crs& crs, int width, int height);

/// The image onto the target, bilinearly. Fails with kInput, and with kCancelled.
Result<void> warp(Session& session, GDALDatasetH image, GDALDatasetH target, const std::string& path,
                  const ProgressCallback& progress);

struct WarpedPixels {
  Picture picture;
  std::vector<std::uint8_t> alpha;  ///< 0: no colour
};
/// Moves the pixels out of a target. Fails with kInput.
Result<WarpedPixels> take_pixels(Session& session, GDALDatasetH target, const std::string& path);

}  // namespace scarp::gdal
