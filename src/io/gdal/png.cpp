// PNG, by GDAL's encoder, in memory.
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal.h>

#include <atomic>

#include "base/caught.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "scarp/io.h"

namespace scarp {
namespace {

tl::unexpected<Error> refuse_png(const std::string& why) {
  return fail(ErrorKind::kOutput, "the picture cannot be encoded as PNG: " + why);
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_png(const Picture& picture) try {
  const int width = picture.width, height = picture.height;
  const auto pixels = static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0));
  if (pixels == 0 || picture.rgb.size() != pixels * 3) {
    return refuse_png(fmt::format("{} x {} pixels and {} bytes do not go together", width, height, picture.rgb.size()));
  }
  gdal::Session session;
  session.set_option("GDAL_PAM_ENABLED", "NO");  // no .aux.xml beside it
  GDALDriverH memory = GDALGetDriverByName("MEM"), png = GDALGetDriverByName("PNG");
  if (memory == nullptr || png == nullptr) return refuse_png("this GDAL has no PNG driver");
  const gdal::Dataset source(GDALCreate(memory, "", width, height, 3, GDT_Byte, nullptr));
  if (!source) return refuse_png(session.reason());
  if (GDALDatasetRasterIOEx(source.get(), GF_Write, 0, 0, width, height, const_cast<std::uint8_t*>(picture.rgb.data()),
                            width, height, GDT_Byte, 3, nullptr, 3, static_cast<GSpacing>(width) * 3, 1,
                            nullptr) != CE_None) {
    return refuse_png(session.reason());
  }
  static std::atomic<unsigned> serial{0};
  const std::string name = fmt::format("/vsimem/scarp-picture-{}.png", serial++);
  GDALClose(GDALCreateCopy(png, name.c_str(), source.get(), FALSE, nullptr, nullptr, nullptr));
  vsi_l_offset size = 0;
  GByte* bytes = VSIGetMemFileBuffer(name.c_str(), &size, TRUE);  // ours to free; the file is gone
  std::vector<std::uint8_t> encoded;
  if (bytes != nullptr && !session.failed()) encoded.assign(bytes, bytes + size);
  VSIFree(bytes);
  if (encoded.empty()) return refuse_png(session.reason());
  return encoded;
} catch (...) {
  return caught(ErrorKind::kOutput, "encode the picture");
}

}  // namespace scarp
