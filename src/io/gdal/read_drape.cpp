// An image, warped onto the place of a raster.
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/caught.h"
#include "io/gdal/georeference.h"
#include "io/gdal/open.h"
#include "scarp/drape.h"

namespace scarp {
namespace gdal {
namespace {

using Transform6 = std::array<double, 6>;

/// Side of the square on which image and raster lie where none has a place; pixels of size 1 would mean no place to
/// GDAL.
constexpr double kNowhere = 0.7;

/// A list of words for GDAL's utilities.
class Words {
 public:
  Words() = default;
  explicit Words(std::initializer_list<std::string> words) {
    for (const std::string& word : words) add(word);
  }
  ~Words() { CSLDestroy(words_); }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  void add(const std::string& word) { words_ = CSLAddString(words_, word.c_str()); }
  char** get() const { return words_; }

 private:
  char** words_ = nullptr;
};

/// The bands that are red, green and blue, and alpha where there is one.
Result<std::vector<int>> choose_bands(GDALDatasetH image, const std::string& path) {
  std::vector<int> colors;
  int alpha = 0;
  for (int k = 1; k <= GDALGetRasterCount(image); ++k) {
    GDALRasterBandH band = GDALGetRasterBand(image, k);
    if (GDALGetRasterDataType(band) != GDT_Byte) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: band {} holds {}, and an image to drape has 8 bits: stretch it first "
                              "(gdal_translate -ot Byte -scale)",
                              path, k, GDALGetDataTypeName(GDALGetRasterDataType(band))));
    }
    if (GDALGetRasterColorInterpretation(band) == GCI_AlphaBand) {
      alpha = k;
    } else if (colors.size() < 3) {
      colors.push_back(k);
    }
  }
  if (colors.empty()) return fail(ErrorKind::kInput, path + ": holds no colours, only transparency");
  if (colors.size() == 2) colors.pop_back();
  while (colors.size() < 3) colors.push_back(colors.front());
  if (alpha > 0) colors.push_back(alpha);
  return colors;
}

/// The image with those bands, colours in place of a palette's numbers; `located`: else it lies on the square.
Result<Dataset> arrange_bands(Session& session, GDALDatasetH image, const std::string& path, bool located) {
  auto bands = choose_bands(image, path);
  if (!bands) return tl::unexpected(bands.error());
  Words words{"-q", "-of", "VRT"};
  if (GDALGetRasterColorTable(GDALGetRasterBand(image, 1)) != nullptr && GDALGetRasterCount(image) == 1) {
    words.add("-expand");
    words.add("rgba");
  } else {
    for (const int band : *bands) {
      words.add("-b");
      words.add(std::to_string(band));
    }
  }
  if (!located) {
    for (const std::string& word : {std::string("-a_ullr"), std::string("0"), std::string("0"),
                                    fmt::to_string(kNowhere), fmt::to_string(kNowhere)})
      words.add(word);
  }
  GDALTranslateOptions* options = GDALTranslateOptionsNew(words.get(), nullptr);
  Dataset arranged(GDALTranslate("", image, options, nullptr));
  GDALTranslateOptionsFree(options);
  if (!arranged) return fail(ErrorKind::kInput, fmt::format("{}: cannot be read: {}", path, session.reason()));
  return arranged;
}

/// A picture in memory on the place of the raster.
Dataset make_target(const Transform6& place, const Crs& crs, int width, int height) {
  constexpr int kBands = 4;
  Dataset target(GDALCreate(GDALGetDriverByName("MEM"), "", width, height, kBands, GDT_Byte, nullptr));
  if (!target) return target;
  Transform6 scaled = place;
  for (const std::size_t k : {1, 4}) scaled[k] /= width;
  for (const std::size_t k : {2, 5}) scaled[k] /= height;
  GDALSetGeoTransform(target.get(), scaled.data());
  if (crs) GDALSetSpatialRef(target.get(), crs.get());
  GDALSetRasterColorInterpretation(GDALGetRasterBand(target.get(), kBands), GCI_AlphaBand);
  return target;
}

/// How many of the image's pixels lie along the raster's sides; nothing if it has no place there.
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

struct Watch {
  const ProgressCallback& progress;
  bool is_cancelled = false;
};

int on_progress(double share, const char*, void* watched) {
  auto& watch = *static_cast<Watch*>(watched);
  watch.is_cancelled = watch.progress && !watch.progress({"read", share, 0, 0});
  return watch.is_cancelled ? FALSE : TRUE;
}

Result<void> warp(Session& session, GDALDatasetH image, GDALDatasetH target, const std::string& path,
                  const ProgressCallback& progress) {
  const Words words{"-q", "-r", "bilinear", "-et", "0.01"};
  Watch watch{progress};
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words.get(), nullptr);
  GDALWarpAppOptionsSetProgress(options, on_progress, &watch);
  GDALDatasetH images[] = {image};
  const bool done = GDALWarp(nullptr, target, 1, images, options, nullptr) != nullptr;
  GDALWarpAppOptionsFree(options);
  if (watch.is_cancelled) return fail(ErrorKind::kCancelled, path + ": reading was cancelled");
  if (!done || session.failed())
    return fail(ErrorKind::kInput, fmt::format("{}: cannot be laid over the raster: {}", path, session.reason()));
  return {};
}

/// White where nothing is.
Result<void> take_pixels(Session& session, GDALDatasetH target, const std::string& path, Drape& drape) {
  const int width = GDALGetRasterXSize(target), height = GDALGetRasterYSize(target);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  drape.picture.width = width;
  drape.picture.height = height;
  drape.picture.rgb.resize(3 * pixels);
  std::vector<std::uint8_t> alpha(pixels);
  const bool read = GDALDatasetRasterIOEx(target, GF_Read, 0, 0, width, height, drape.picture.rgb.data(), width, height,
                                          GDT_Byte, 3, nullptr, 3, GSpacing{3} * width, 1, nullptr) == CE_None &&
                    GDALRasterIO(GDALGetRasterBand(target, 4), GF_Read, 0, 0, width, height, alpha.data(), width,
                                 height, GDT_Byte, 0, 0) == CE_None;
  if (!read) return fail(ErrorKind::kInput, fmt::format("{}: cannot be read: {}", path, session.reason()));
  std::size_t covered = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    covered += alpha[i] > 0;
    if (alpha[i] == 0) std::fill_n(&drape.picture.rgb[3 * i], 3, std::uint8_t{255});
  }
  drape.covered = static_cast<double>(covered) / static_cast<double>(pixels);
  return {};
}

Result<Drape> read(const std::string& path, const RasterInfo& raster, int cols, int rows, int size, const Run& run) {
  Session session(is_remote(path));
  auto image = open_raster(session, path);
  if (!image) return tl::unexpected(image.error());
  const auto geo = read_georeference(image->get(), path);
  if (!geo) return tl::unexpected(geo.error());
  // An image with as many pixels as the raster has samples is most likely made from it, and has lost its place.
  const bool is_twin = !geo->located && geo->cols == cols && geo->rows == rows;
  if (geo->located != raster.has_georeference && !is_twin) {
    return fail(ErrorKind::kInput,
                fmt::format("{} has {}, and the raster has {}: give {} a georeference first (gdal_translate -a_ullr "
                            "-a_srs){}",
                            path, geo->located ? "a place" : "no place", geo->located ? "none" : "one",
                            geo->located ? "the raster" : "it",
                            geo->located ? "" : fmt::format(", or an image of {} x {} pixels", cols, rows)));
  }
  Drape drape;
  if (is_twin && raster.has_georeference)
    drape.warnings.push_back(
        fmt::format("{} has no place, and as many pixels as the raster has samples: each is laid "
                    "on its sample",
                    path));
  auto arranged = arrange_bands(session, image->get(), path, geo->located);
  if (!arranged) return tl::unexpected(arranged.error());
  Transform6 place{0, kNowhere, 0, 0, 0, kNowhere};
  Crs crs;
  if (geo->located) {
    place = raster.geotransform;
    for (const std::size_t k : {1, 4}) place[k] *= cols;
    for (const std::size_t k : {2, 5}) place[k] *= rows;
    if (!raster.crs.empty()) crs = find_crs(raster.crs);
    if (!geo->crs != !crs) {
      drape.warnings.push_back(fmt::format("{} has {} CRS, and the raster has {}: they are taken for the same", path,
                                           crs ? "no" : "a", crs ? "one" : "none"));
      if (!crs) crs = copy_crs(geo->crs.get());
      if (!geo->crs) GDALSetSpatialRef(arranged->get(), crs.get());
    }
  }
  const auto off_raster = [&] { return fail(ErrorKind::kInput, path + ": does not lie on the raster"); };
  const auto pixels = count_pixels(arranged->get(), place, crs);
  if (!pixels) return off_raster();
  const auto [width, height] = choose_size(*pixels, size);
  const Dataset target = make_target(place, crs, width, height);
  if (!target) return fail(ErrorKind::kInput, fmt::format("{}: {}", path, session.reason()));
  session.clear();
  if (auto warped = warp(session, arranged->get(), target.get(), path, run.progress); !warped)
    return tl::unexpected(warped.error());
  if (auto taken = take_pixels(session, target.get(), path, drape); !taken) return tl::unexpected(taken.error());
  if (drape.covered == 0) return off_raster();
  if (drape.covered < 1) {
    drape.warnings.push_back(fmt::format("{} covers {:.1f} % of the raster: the rest is white", path,
                                         std::floor(drape.covered * 1000) / 10));
  }
  return drape;
}

}  // namespace
}  // namespace gdal

Result<Drape> read_drape(const std::string& path, const RasterInfo& raster, int cols, int rows, int size,
                         const Run& run) try {
  return gdal::read(path, raster, cols, rows, size, run);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
