// GeoTIFF, by GDAL.
#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/mosaic.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/raster/raster_source.h"

namespace scarp::io {
namespace {

constexpr std::string_view kGenerated = "generated";  // RasterInfo::format of a field not read from a raster

tl::unexpected<Error> refuse_geotiff(const std::string& why) {
  return fail(ErrorKind::kOutput, "the raster cannot be encoded as GeoTIFF: " + why);
}

/// Writes blocks without GDAL's block cache. There they would displace blocks of the rasters being read, and two block
/// sizes would fragment memory.
class GdalGeoTiff final : public GeoTiff {
 public:
  GdalGeoTiff(gdal::Dataset dataset, int cols) : dataset_(std::move(dataset)), cols_(cols) {
    GDALGetBlockSize(GDALGetRasterBand(dataset_.get(), 1), &block_cols_, &block_rows_);
    block_.resize(static_cast<std::size_t>(block_cols_) * static_cast<std::size_t>(block_rows_));
  }
  ~GdalGeoTiff() override {
    if (dataset_) std::ignore = close();
  }

  Result<void> write(int row, int rows, const float* samples) override {
    gdal::Session session;
    GDALRasterBandH band = GDALGetRasterBand(dataset_.get(), 1);
    for (int first = 0; first < rows; first += block_rows_) {
      for (int col = 0; col < cols_; col += block_cols_) {
        fill_block(samples + static_cast<std::size_t>(first) * static_cast<std::size_t>(cols_) + col,
                   std::min(block_rows_, rows - first), std::min(block_cols_, cols_ - col));
        const CPLErr written = GDALWriteBlock(band, col / block_cols_, (row + first) / block_rows_, block_.data());
        if (written != CE_None || session.failed()) return refuse_geotiff(session.reason());
      }
    }
    return {};
  }
  Result<void> close() override {
    gdal::Session session;
    session.set_option("GDAL_PAM_ENABLED", "NO");  // no .aux.xml next to the file
    dataset_.reset();
    if (session.failed()) return refuse_geotiff(session.reason());
    return {};
  }

 private:
  /// Pads with zeros beyond the raster's last column and row.
  void fill_block(const float* samples, int rows, int cols) {
    std::fill(block_.begin(), block_.end(), 0.0f);
    for (int y = 0; y < rows; ++y) {
      const float* from = samples + static_cast<std::size_t>(y) * static_cast<std::size_t>(cols_);
      std::copy_n(from, cols, block_.begin() + static_cast<std::ptrdiff_t>(y) * block_cols_);
    }
  }

  gdal::Dataset dataset_;
  int cols_, block_cols_ = 0, block_rows_ = 0;
  std::vector<float> block_;
};

}  // namespace

Result<std::unique_ptr<GeoTiff>> create_geotiff(const std::string& path, int cols, int rows, const RasterInfo* like) {
  gdal::Session session;
  session.set_option("GDAL_PAM_ENABLED", "NO");
  GDALDriverH driver = GDALGetDriverByName("GTiff");
  if (driver == nullptr) return refuse_geotiff("this GDAL has no GTiff driver");
  gdal::Crs crs;
  if (like != nullptr && !like->crs.empty()) {
    const bool keeps_heights = like->z_scale == 1 && like->z_offset == 0 && !like->crs_with_heights.empty();
    crs = keeps_heights ? gdal::find_declared_crs(like->crs_with_heights) : gdal::find_crs(like->crs);
    if (!crs) return refuse_geotiff(fmt::format("'{}' is no CRS that GDAL knows", like->crs));
  }
  const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3",      "TILED=YES",
                           "NUM_THREADS=1",    "BIGTIFF=IF_SAFER", nullptr};
  gdal::Dataset dataset(GDALCreate(driver, path.c_str(), cols, rows, 1, GDT_Float32, options));
  if (!dataset) return refuse_geotiff(session.reason());
  bool good = true;
  if (like != nullptr && like->has_georeference) {
    std::array<double, 6> geotransform = like->geotransform;
    good = GDALSetGeoTransform(dataset.get(), geotransform.data()) == CE_None;
  }
  if (crs) good = good && GDALSetSpatialRef(dataset.get(), crs.get()) == CE_None;
  GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
  good = good && GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN()) == CE_None;
  if (like != nullptr && !like->unit.empty()) {
    good = good && GDALSetRasterUnitType(band, like->unit.c_str()) == CE_None;
  }
  const bool is_derived = like != nullptr && like->format != kGenerated;
  if (is_derived) good = good && gdal::mark_derived(dataset.get());
  if (!good || session.failed()) return refuse_geotiff(session.reason());
  return std::make_unique<GdalGeoTiff>(std::move(dataset), cols);
}

Result<std::vector<std::uint8_t>> encode_geotiff(const RasterImage& raster) {
  const gdal::MemoryFile file("tif");
  SCARP_TRY(auto&& tiff, create_geotiff(file.name(), raster.cols, raster.rows, raster.like));
  SCARP_RETURN_IF_ERROR(tiff->write(0, raster.rows, raster.samples.data()));
  SCARP_RETURN_IF_ERROR(tiff->close());
  std::vector<std::uint8_t> bytes = file.bytes();
  if (bytes.empty()) return refuse_geotiff("GDAL has written nothing");
  return bytes;
}

}  // namespace scarp::io
