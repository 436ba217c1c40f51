// Heights packed into red, green and blue.
//
//   terrarium:  R·256 + G + B/256 − 32768            steps of 1/256 m: exact in float32
//   mapbox:     −10000 + (R·65536 + G·256 + B)·0.1   steps of 0.1 m: rounded to float32, the rounding recorded
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "io/gdal/read_samples.h"

namespace scarp::gdal {
namespace {

double decode_height(Decode decode, const std::uint8_t* rgb) {
  if (decode == Decode::kTerrarium) return rgb[0] * 256 + rgb[1] + rgb[2] / 256.0 - 32768;
  return -10000 + (rgb[0] * 65536 + rgb[1] * 256 + rgb[2]) * 0.1;
}

/// A colour that stands for nodata: every band's declared value.
std::optional<std::array<std::uint8_t, 3>> find_nodata_colour(GDALDatasetH dataset) {
  std::array<std::uint8_t, 3> colour{};
  for (int k = 0; k < 3; ++k) {
    int declared = 0;
    const double value = GDALGetRasterNoDataValue(GDALGetRasterBand(dataset, k + 1), &declared);
    if (!declared || !(value >= 0 && value <= 255) || std::floor(value) != value) return {};
    colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

class PackedReader : public WindowReader {
 public:
  PackedReader(GDALDatasetH dataset, const ReadOptions& options)
      : dataset_(dataset),
        decode_(options.decode),
        z_scale_(options.z_scale),
        z_offset_(options.z_offset),
        nodata_(options.nodata),
        bands_(GDALGetRasterCount(dataset)),
        red_(GDALGetRasterBand(dataset, 1)),
        masked_(bands_ == 3 && (GDALGetMaskFlags(red_) & GMF_PER_DATASET) != 0),
        nodata_colour_(options.nodata ? std::nullopt : find_nodata_colour(dataset)) {}

  bool read(const Window& w, float* out, std::ptrdiff_t stride) override {
    const auto count = static_cast<std::size_t>(w.cols) * static_cast<std::size_t>(w.rows);
    const auto depth = static_cast<std::size_t>(bands_);
    pixels_.resize(count * depth);
    if (GDALDatasetRasterIOEx(dataset_, GF_Read, w.col, w.row, w.cols, w.rows, pixels_.data(), w.cols, w.rows, GDT_Byte,
                              bands_, nullptr, bands_, static_cast<GSpacing>(bands_) * w.cols, 1, nullptr) != CE_None) {
      return false;
    }
    if (masked_) {
      mask_.resize(count);
      if (GDALRasterIOEx(GDALGetMaskBand(red_), GF_Read, w.col, w.row, w.cols, w.rows, mask_.data(), w.cols, w.rows,
                         GDT_Byte, 0, 0, nullptr) != CE_None) {
        return false;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<std::ptrdiff_t>(k / static_cast<std::size_t>(w.cols));
      const auto col = static_cast<std::ptrdiff_t>(k % static_cast<std::size_t>(w.cols));
      out[row * stride + col] = height_of(pixels_.data() + k * depth, masked_ && mask_[k] == 0);
    }
    return true;
  }

 private:
  float height_of(const std::uint8_t* rgb, bool is_masked) {
    const double height = decode_height(decode_, rgb);
    const bool is_nodata = (bands_ == 4 && rgb[3] == 0) || is_masked ||
                           (nodata_colour_ && std::equal(rgb, rgb + 3, nodata_colour_->begin())) ||
                           (nodata_ && static_cast<float>(*nodata_) == static_cast<float>(height));
    if (is_nodata) return std::numeric_limits<float>::quiet_NaN();
    const double scaled = z_scale_ * height + z_offset_;
    const auto z = static_cast<float>(scaled);
    findings_.rounding = std::max(findings_.rounding, std::abs(scaled - static_cast<double>(z)));
    return z;
  }

  GDALDatasetH dataset_;
  Decode decode_;
  double z_scale_, z_offset_;
  std::optional<double> nodata_;
  int bands_;
  GDALRasterBandH red_;
  bool masked_;
  std::optional<std::array<std::uint8_t, 3>> nodata_colour_;
  std::vector<std::uint8_t> pixels_, mask_;
};

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

std::unique_ptr<WindowReader> make_packed_reader(GDALDatasetH dataset, const ReadOptions& options) {
  return std::make_unique<PackedReader>(dataset, options);
}

}  // namespace scarp::gdal
