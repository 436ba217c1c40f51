// GeoTIFF, by GDAL.
#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>

#include <limits>
#include <memory>
#include <utility>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/raster/raster_source.h"

namespace scarp {
namespace {

tl::unexpected<Error> refuse_geotiff(const std::string& why) {
  return fail(ErrorKind::kOutput, "the raster cannot be encoded as GeoTIFF: " + why);
}

class GdalGeoTiff final : public GeoTiff {
 public:
  GdalGeoTiff(gdal::Dataset dataset, int cols) : dataset_(std::move(dataset)), cols_(cols) {}

  Result<void> write(int row, int rows, const float* samples) override {
    gdal::Session session;
    GDALRasterBandH band = GDALGetRasterBand(dataset_.get(), 1);
    const bool good = GDALRasterIOEx(band, GF_Write, 0, row, cols_, rows, const_cast<float*>(samples), cols_, rows,
                                     GDT_Float32, 0, 0, nullptr) == CE_None &&
                      GDALFlushRasterCache(band) == CE_None;  // here, not by whoever reads another file next
    if (!good || session.failed()) return refuse_geotiff(session.reason());
    return {};
  }
  Result<void> close() override {
    gdal::Session session;
    session.set_option("GDAL_PAM_ENABLED", "NO");  // no .aux.xml beside it
    dataset_.reset();
    if (session.failed()) return refuse_geotiff(session.reason());
    return {};
  }

 private:
  gdal::Dataset dataset_;
  int cols_;
};

}  // namespace

Result<std::unique_ptr<GeoTiff>> create_geotiff(const std::string& path, int cols, int rows, const RasterInfo* like) {
  gdal::Session session;
  session.set_option("GDAL_PAM_ENABLED", "NO");
  GDALDriverH driver = GDALGetDriverByName("GTiff");
  if (driver == nullptr) return refuse_geotiff("this GDAL has no GTiff driver");
  gdal::Crs crs;
  if (like != nullptr && !like->crs.empty()) {
    crs = gdal::find_crs(like->crs);
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
  if (!good || session.failed()) return refuse_geotiff(session.reason());
  return std::make_unique<GdalGeoTiff>(std::move(dataset), cols);
}

Result<std::vector<std::uint8_t>> encode_geotiff(const RasterImage& raster) {
  const gdal::MemoryFile file("tif");
  auto tiff = create_geotiff(file.name(), raster.cols, raster.rows, raster.like);
  if (!tiff) return tl::unexpected(tiff.error());
  if (auto written = (*tiff)->write(0, raster.rows, raster.samples.data()); !written)
    return tl::unexpected(written.error());
  if (auto closed = (*tiff)->close(); !closed) return tl::unexpected(closed.error());
  std::vector<std::uint8_t> bytes = file.bytes();
  if (bytes.empty()) return refuse_geotiff("GDAL has written nothing");
  return bytes;
}

}  // namespace scarp
