// The part of the globe that a raster covers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/tile.h"

namespace scarp {
namespace {

/// Number of raster positions examined in each direction.
constexpr int kPlaces = 257;
/// Degrees from Greenwich. Grids search for land up to two turns away.
constexpr double kFarthest = 720;

struct Span {
  double low = INFINITY, high = -INFINITY, step = 0;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

}  // namespace

Result<DegreeBox> degrees_covered(const HeightField& field, const std::array<double, 6>& affine,
                                  const PointTransform* to_degrees) {
  std::vector<double> xs, ys;
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i) {
      const double col = -0.5 + static_cast<double>(field.cols) * i / (kPlaces - 1);
      const double row = -0.5 + static_cast<double>(field.rows) * j / (kPlaces - 1);
      xs.push_back(affine[0] + affine[1] * col + affine[2] * row);
      ys.push_back(affine[3] + affine[4] * col + affine[5] * row);
    }
  }
  if (to_degrees != nullptr) to_degrees->apply(xs, ys);
  Span longitudes, latitudes;
  for (std::size_t k = 0; k < xs.size(); ++k) {
    if (!std::isfinite(xs[k]) || !std::isfinite(ys[k])) continue;
    for (const std::size_t other : {k % kPlaces > 0 ? k - 1 : k, k >= kPlaces ? k - kPlaces : k}) {
      if (!std::isfinite(xs[other]) || !std::isfinite(ys[other])) continue;
      // Add or subtract a turn, so that adjacent positions are adjacent in degrees.
      if (to_degrees != nullptr) xs[k] -= 360 * std::floor((xs[k] - xs[other]) / 360 + 0.5);
      longitudes.step = std::max(longitudes.step, std::abs(xs[k] - xs[other]));
      latitudes.step = std::max(latitudes.step, std::abs(ys[k] - ys[other]));
    }
    longitudes.add(xs[k]);
    latitudes.add(ys[k]);
  }
  if (!(longitudes.low <= longitudes.high) || latitudes.low >= 90 || latitudes.high <= -90)
    return fail(ErrorKind::kInput, "no part of the raster lies on the globe");
  if (longitudes.low < -kFarthest || longitudes.high > kFarthest)
    return fail(ErrorKind::kInput,
                fmt::format("longitudes of {} to {} are no place on the globe: give them within {} degrees "
                            "(gdal_translate -a_ullr WEST NORTH EAST SOUTH FILE NEW.tif), or their CRS if they are not "
                            "degrees (gdal_translate -a_srs EPSG:CODE FILE NEW.tif)",
                            longitudes.low, longitudes.high, kFarthest));
  if (to_degrees != nullptr) {
    // The raster may extend a step beyond the examined positions, and around a pole to all longitudes.
    longitudes.low -= longitudes.step;
    longitudes.high += longitudes.step;
    latitudes.low -= latitudes.step;
    latitudes.high += latitudes.step;
    if (longitudes.step > 45) longitudes = {-180, 180, 0};
    if (latitudes.high >= 90 || latitudes.low <= -90) longitudes = {-180, 180, 0};
  }
  if (longitudes.high - longitudes.low >= 360) longitudes = {-180, 180, 0};
  return DegreeBox{longitudes.low, std::max(latitudes.low, -90.0), longitudes.high, std::min(latitudes.high, 90.0)};
}

}  // namespace scarp
