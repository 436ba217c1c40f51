#include "io/gdal/warp_image.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <utility>

#include "io/commands.h"

namespace scarp::gdal {
namespace {

/// A list of arguments for GDAL's utilities.
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

/// The red, green and blue bands, and alpha if present.
Result<std::vector<int>> choose_bands(GDALDatasetH image, const std::string& path) {
  std::vector<int> colors;
  int alpha = 0;
  for (int k = 1; k <= GDALGetRasterCount(image); ++k) {
    GDALRasterBandH band = GDALGetRasterBand(image, k);
    if (GDALGetRasterDataType(band) != GDT_Byte) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: band {} holds {}, and an image to drape has 8 bits: stretch it first "
                              "({})",
                              path, k, GDALGetDataTypeName(GDALGetRasterDataType(band)),
                              io::translate_command("-ot Byte -scale", path)));
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

struct Watch {
  const ProgressCallback& progress;
  bool is_cancelled = false;
};

int on_progress(double share, const char*, void* watched) {
  auto& watch = *static_cast<Watch*>(watched);
  watch.is_cancelled = watch.progress && !watch.progress({"read", share, 0, 0});
  return watch.is_cancelled ? FALSE : TRUE;
}

}  // namespace

Result<Dataset> arrange_bands(Session& session, GDALDatasetH image, const std::string& path, bool located) {
  SCARP_TRY(auto&& bands, choose_bands(image, path));
  Words words{"-q", "-of", "VRT"};
  if (GDALGetRasterColorTable(GDALGetRasterBand(image, 1)) != nullptr && GDALGetRasterCount(image) == 1) {
    words.add("-expand");
    words.add("rgba");
  } else {
    for (const int band : bands) {
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

Result<WarpedPixels> take_pixels(Session& session, GDALDatasetH target, const std::string& path) {
  const int width = GDALGetRasterXSize(target), height = GDALGetRasterYSize(target);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  WarpedPixels warped;
  warped.picture.width = width;
  warped.picture.height = height;
  warped.picture.rgb.resize(3 * pixels);
  warped.alpha.resize(pixels);
  const bool read =
      GDALDatasetRasterIOEx(target, GF_Read, 0, 0, width, height, warped.picture.rgb.data(), width, height, GDT_Byte, 3,
                            nullptr, 3, GSpacing{3} * width, 1, nullptr) == CE_None &&
      GDALRasterIO(GDALGetRasterBand(target, 4), GF_Read, 0, 0, width, height, warped.alpha.data(), width, height,
                   GDT_Byte, 0, 0) == CE_None;
  if (!read) return fail(ErrorKind::kInput, fmt::format("{}: cannot be read: {}", path, session.reason()));
  return warped;
}

}  // namespace scarp::gdal
