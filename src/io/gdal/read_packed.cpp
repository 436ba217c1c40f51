// Heights packed into red, green and blue.
//
//   terrarium:  R·256 + G + B/256 − 32768            steps of 1/256 m: exact in float32
//   mapbox:     −10000 + (R·65536 + G·256 + B)·0.1   steps of 0.1 m: rounded to float32, the rounding recorded
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "io/gdal/read_samples.h"
#include "io/gdal/windows.h"

namespace scarp::gdal {
namespace {

double decode_height(Decode decode, const std::uint8_t* rgb) {
  if (decode == Decode::kTerrarium) return rgb[0] * 256 + rgb[1] + rgb[2] / 256.0 - 32768;
  return -10000 + (rgb[0] * 65536 + rgb[1] * 256 + rgb[2]) * 0.1;
}

/// A colour that stands for nodata: every band's declared value.
std::optional<std::array<std::uint8_t, 3>> find_void_colour(GDALDatasetH dataset) {
  std::array<std::uint8_t, 3> colour{};
  for (int k = 0; k < 3; ++k) {
    int declared = 0;
    const double value = GDALGetRasterNoDataValue(GDALGetRasterBand(dataset, k + 1), &declared);
    if (!declared || !(value >= 0 && value <= 255) || std::floor(value) != value) return {};
    colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

}  // namespace

Result<void> verify_packed(GDALDatasetH dataset, const std::string& path) {
  const int count = GDALGetRasterCount(dataset);
  bool bytes = count == 3 || count == 4;
  for (int k = 1; bytes && k <= count; ++k) bytes = GDALGetRasterDataType(GDALGetRasterBand(dataset, k)) == GDT_Byte;
  if (bytes) return {};
  return fail(
      ErrorKind::kInput,
      fmt::format("{}: heights packed into colours need 3 or 4 bands of bytes, and this raster has {} of type {}", path,
                  count, GDALGetDataTypeName(GDALGetRasterDataType(GDALGetRasterBand(dataset, 1)))));
}

Result<void> read_packed(Session& session, GDALDatasetH dataset, const ReadOptions& options, OwnedHeightField& field) {
  const int bands = GDALGetRasterCount(dataset);
  GDALRasterBandH red = GDALGetRasterBand(dataset, 1);
  const int mask_flags = GDALGetMaskFlags(red);
  const bool masked = bands == 3 && (mask_flags & GMF_PER_DATASET) != 0;
  const auto void_colour = options.nodata ? std::nullopt : find_void_colour(dataset);
  std::vector<std::uint8_t> pixels, mask;
  return for_each_window(session, red, field, options.progress, [&](const Window& w) {
    const auto count = static_cast<std::size_t>(w.cols) * static_cast<std::size_t>(w.rows);
    const auto depth = static_cast<std::size_t>(bands);
    pixels.resize(count * depth);
    if (GDALDatasetRasterIOEx(dataset, GF_Read, w.col, w.row, w.cols, w.rows, pixels.data(), w.cols, w.rows, GDT_Byte,
                              bands, nullptr, bands, static_cast<GSpacing>(bands) * w.cols, 1, nullptr) != CE_None) {
      return false;
    }
    if (masked) {
      mask.resize(count);
      if (GDALRasterIOEx(GDALGetMaskBand(red), GF_Read, w.col, w.row, w.cols, w.rows, mask.data(), w.cols, w.rows,
                         GDT_Byte, 0, 0, nullptr) != CE_None) {
        return false;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint8_t* rgb = pixels.data() + k * depth;
      const std::size_t row = static_cast<std::size_t>(w.row) + k / static_cast<std::size_t>(w.cols);
      const std::size_t col = static_cast<std::size_t>(w.col) + k % static_cast<std::size_t>(w.cols);
      float& z = field.samples[row * static_cast<std::size_t>(field.cols) + col];
      const double height = decode_height(options.decode, rgb);
      const bool is_void = (bands == 4 && rgb[3] == 0) || (masked && mask[k] == 0) ||
                           (void_colour && std::equal(rgb, rgb + 3, void_colour->begin())) ||
                           (options.nodata && static_cast<float>(*options.nodata) == static_cast<float>(height));
      z = is_void ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(height);
      if (!is_void) {
        field.sample_rounding = std::max(field.sample_rounding, std::abs(height - static_cast<double>(z)));
      }
    }
    return true;
  });
}

}  // namespace scarp::gdal
