// Reads GeoTIFF keys that are not in a GeoTIFF. They are put into a GeoTIFF of one sample in memory, which GDAL reads.
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/raster/crs_description.h"

namespace scarp::gdal {
namespace {

/// Builds a TIFF of one sample, in the processor's byte order.
class SmallTiff {
 public:
  enum Type : std::uint16_t { kText = 2, kShort = 3, kLong = 4, kDouble = 12 };

  void add(std::uint16_t tag, std::uint32_t value) { add_entry(tag, kLong, 1, value); }
  /// REQUIRES: tags ascend.
  void add(std::uint16_t tag, Type type, std::span<const std::uint8_t> values) {
    const std::size_t size = type == kText ? 1 : type == kShort ? 2 : 8;
    const auto count = static_cast<std::uint32_t>(values.size() / size);
    if (count * size <= 4) return;  // such values are in the entry; no keys are that short
    add_entry(tag, type, count, static_cast<std::uint32_t>(kHead + values_.size()));
    values_.insert(values_.end(), values.begin(), values.end());
    values_.resize((values_.size() + 7) / 8 * 8);
  }

  /// The first of the values also serves as the sample.
  std::vector<std::uint8_t> finish() const {
    std::vector<std::uint8_t> bytes(kHead);
    const std::uint16_t order = CPL_IS_LSB ? 0x4949 : 0x4D4D, mark = 42;
    const auto place = static_cast<std::uint32_t>(kHead + values_.size());
    std::memcpy(bytes.data(), &order, 2);
    std::memcpy(bytes.data() + 2, &mark, 2);
    std::memcpy(bytes.data() + 4, &place, 4);
    bytes.insert(bytes.end(), values_.begin(), values_.end());
    const auto count = static_cast<std::uint16_t>(entries_.size() / 12);
    const auto* const at = reinterpret_cast<const std::uint8_t*>(&count);
    bytes.insert(bytes.end(), at, at + 2);
    bytes.insert(bytes.end(), entries_.begin(), entries_.end());
    bytes.resize(bytes.size() + 4);  // there is no other image
    return bytes;
  }
  static constexpr std::size_t kHead = 8;

 private:
  void add_entry(std::uint16_t tag, Type type, std::uint32_t count, std::uint32_t value) {
    std::uint8_t entry[12];
    std::memcpy(entry, &tag, 2);
    std::memcpy(entry + 2, &type, 2);
    std::memcpy(entry + 4, &count, 4);
    std::memcpy(entry + 8, &value, 4);
    entries_.insert(entries_.end(), entry, entry + sizeof entry);
  }

  std::vector<std::uint8_t> values_ = std::vector<std::uint8_t>(8), entries_;
};

std::string read_crs(std::vector<std::uint8_t> tiff) {
  Session quiet;
  const MemoryFile file("tif");
  VSILFILE* const opened = VSIFileFromMemBuffer(file.name(), tiff.data(), tiff.size(), FALSE);
  if (opened == nullptr || VSIFCloseL(opened) != 0) return "";
  const char* const drivers[] = {"GTiff", nullptr};
  const Dataset dataset(GDALOpenEx(file.name(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr, nullptr));
  if (!dataset) return "";
  const Crs crs = declared_crs(dataset.get());
  char* text = nullptr;
  std::string wkt;
  if (crs && OSRExportToWkt(crs.get(), &text) == OGRERR_NONE && text != nullptr) wkt = text;
  CPLFree(text);
  return wkt;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

std::string describe_geo_keys(const GeoKeys& keys) {
  gdal::SmallTiff tiff;
  for (const auto& [tag, value] : {std::pair<std::uint16_t, std::uint32_t>{256, 1},
                                   {257, 1},
                                   {258, 8},
                                   {259, 1},
                                   {262, 1},
                                   {273, gdal::SmallTiff::kHead},
                                   {277, 1},
                                   {278, 1},
                                   {279, 1}})
    tiff.add(tag, value);
  tiff.add(34735, gdal::SmallTiff::kShort, keys.directory);
  tiff.add(34736, gdal::SmallTiff::kDouble, keys.doubles);
  tiff.add(34737, gdal::SmallTiff::kText, keys.texts);
  return gdal::read_crs(tiff.finish());
}

}  // namespace scarp::io
