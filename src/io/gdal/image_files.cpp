// Images, by GDAL's encoders, in memory.
#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>

#include "base/caught.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "scarp/io.h"

namespace scarp {
namespace {

struct Encoder {
  const char* driver;
  const char* extension;
  const char* option;
};
constexpr Encoder kEncoders[] = {
    {"PNG", "png", nullptr}, {"JPEG", "jpg", "QUALITY=90"}, {"WEBP", "webp", "QUALITY=90"}};

}  // namespace

Result<std::vector<std::uint8_t>> encode_image(const Picture& picture, ImageFormat format) try {
  const Encoder& encoder = kEncoders[static_cast<int>(format)];
  const auto refuse = [&](const std::string& why) {
    return fail(ErrorKind::kOutput, fmt::format("the picture cannot be encoded as {}: {}", encoder.driver, why));
  };
  const int width = picture.width, height = picture.height;
  const auto pixels = static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0));
  if (pixels == 0 || picture.rgb.size() != pixels * 3) {
    return refuse(fmt::format("{} x {} pixels and {} bytes do not go together", width, height, picture.rgb.size()));
  }
  gdal::Session session;
  session.set_option("GDAL_PAM_ENABLED", "NO");  // no .aux.xml next to it
  GDALDriverH memory = GDALGetDriverByName("MEM"), driver = GDALGetDriverByName(encoder.driver);
  if (memory == nullptr || driver == nullptr) return refuse(fmt::format("this GDAL has no {} driver", encoder.driver));
  const gdal::Dataset source(GDALCreate(memory, "", width, height, 3, GDT_Byte, nullptr));
  if (!source) return refuse(session.reason());
  if (GDALDatasetRasterIOEx(source.get(), GF_Write, 0, 0, width, height, const_cast<std::uint8_t*>(picture.rgb.data()),
                            width, height, GDT_Byte, 3, nullptr, 3, static_cast<GSpacing>(width) * 3, 1,
                            nullptr) != CE_None) {
    return refuse(session.reason());
  }
  const gdal::MemoryFile file(encoder.extension);
  char** options = encoder.option != nullptr ? CSLAddString(nullptr, encoder.option) : nullptr;
  GDALClose(GDALCreateCopy(driver, file.name(), source.get(), FALSE, options, nullptr, nullptr));
  CSLDestroy(options);
  std::vector<std::uint8_t> encoded = file.bytes();
  if (encoded.empty() || session.failed()) return refuse(session.reason());
  return encoded;
} catch (...) {
  return caught(ErrorKind::kOutput, "encode the picture");
}

Result<std::vector<std::uint8_t>> encode_png(const Picture& picture) {
  return encode_image(picture, ImageFormat::kPng);
}

}  // namespace scarp
