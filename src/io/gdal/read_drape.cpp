// Reads an image, warped to the position of a raster.
#include <fmt/format.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/caught.h"
#include "io/commands.h"
#include "io/gdal/georeference.h"
#include "io/gdal/warp_image.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

/// Number of the image's pixels along the raster's sides; nothing if the conversion fails.
std::optional<std::array<double, 2>> count_pixels(GDALDatasetH image, const Transform6& place, const Crs& crs) {
  const Dataset square = make_target(place, crs, 1, 1);
  if (!square) return {};
  void* transformer = GDALCreateGenImgProjTransformer2(image, square.get(), nullptr);
  if (transformer == nullptr) return {};
  double x[] = {0, 1, 0, 1}, y[] = {0, 0, 1, 1}, z[] = {0, 0, 0, 0};
  int found[] = {0, 0, 0, 0};
  GDALGenImgProjTransform(transformer, TRUE, 4, x, y, z, found);
  GDALDestroyGenImgProjTransformer(transformer);
  if (!std::all_of(found, found + 4, [](int has) { return has != 0; })) return {};
  const auto length = [&](int i, int j) { return std::hypot(x[j] - x[i], y[j] - y[i]); };
  return std::array{std::max(length(0, 1), length(2, 3)), std::max(length(0, 2), length(1, 3))};
}

std::array<int, 2> choose_size(const std::array<double, 2>& pixels, int size) {
  constexpr double kMost = 8192;
  const double longer = std::max({pixels[0], pixels[1], 1e-9});
  const double scale = (size > 0 ? size : std::min(longer, kMost)) / longer;
  const auto side = [scale](double count) { return static_cast<int>(std::max(1.0, std::round(count * scale))); };
  return {side(pixels[0]), side(pixels[1])};
}

void lay_on_white(WarpedPixels warped, Drape& drape) {
  const std::size_t pixels = warped.alpha.size();
  std::size_t covered = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    covered += warped.alpha[i] > 0;
    if (warped.alpha[i] == 0) std::fill_n(&warped.picture.rgb[3 * i], 3, std::uint8_t{255});
  }
  drape.picture = std::move(warped.picture);
  drape.covered = static_cast<double>(covered) / static_cast<double>(pixels);
}

Result<Drape> read(const std::string& path, const RasterInfo& raster, int cols, int rows, int size, const Run& run) {
  Session session(is_remote(path));
  SCARP_TRY(auto&& image, open_raster(session, path));
  SCARP_TRY(const auto& geo, read_georeference(image.get(), path));
  // An image with as many pixels as the raster has samples was probably made from it, and lost its georeference.
  const bool is_twin = !geo.located && geo.cols == cols && geo.rows == rows;
  if (geo.located != raster.has_georeference && !is_twin) {
    return fail(
        ErrorKind::kInput,
        fmt::format(
            "{} has {}, and the raster has {}: give {} a place first ({}){}", path,
            geo.located ? "a place" : "no place", geo.located ? "none" : "one", geo.located ? "the raster" : "it",
            io::translate_command("-a_srs EPSG:CODE -a_ullr WEST NORTH EAST SOUTH", geo.located ? raster.path : path),
            geo.located ? "" : fmt::format(", or an image of {} x {} pixels", cols, rows)));
  }
  Drape drape;
  if (is_twin && raster.has_georeference)
    drape.warnings.push_back(
        fmt::format("{} has no place, and as many pixels as the raster has samples: each is laid "
                    "on its sample",
                    path));
  SCARP_TRY(auto&& arranged, arrange_bands(session, image.get(), path, geo.located));
  Transform6 place{0, kNowhere, 0, 0, 0, kNowhere};
  Crs crs;
  if (geo.located) {
    place = raster.geotransform;
    for (const std::size_t k : {1, 4}) place[k] *= cols;
    for (const std::size_t k : {2, 5}) place[k] *= rows;
    if (!raster.crs.empty()) crs = find_crs(raster.crs);
    if (!geo.crs != !crs) {
      drape.warnings.push_back(fmt::format("{} has {} CRS, and the raster has {}: they are taken for the same", path,
                                           crs ? "no" : "a", crs ? "one" : "none"));
      if (!crs) crs = copy_crs(geo.crs.get());
      if (!geo.crs) GDALSetSpatialRef(arranged.get(), crs.get());
    }
  }
  const auto off_raster = [&] { return fail(ErrorKind::kInput, path + ": does not lie on the raster"); };
  const auto pixels = count_pixels(arranged.get(), place, crs);
  if (!pixels) return off_raster();
  const auto [width, height] = choose_size(*pixels, size);
  const Dataset target = make_target(place, crs, width, height);
  if (!target) return fail(ErrorKind::kInput, fmt::format("{}: {}", path, session.reason()));
  session.clear();
  SCARP_RETURN_IF_ERROR(warp(session, arranged.get(), target.get(), path, run.progress));
  SCARP_TRY(auto&& pixels_there, take_pixels(session, target.get(), path));
  lay_on_white(std::move(pixels_there), drape);
  if (drape.covered == 0) return off_raster();
  if (drape.covered < 1) {
    drape.warnings.push_back(fmt::format("{} covers {:.1f} % of the raster: the rest is white", path,
                                         std::floor(drape.covered * 1000) / 10));
  }
  return drape;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp {

Result<Drape> read_drape(const std::string& path, const RasterInfo& raster, int cols, int rows, int size,
                         const Run& run) try {
  return gdal::read(path, raster, cols, rows, size, run);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
