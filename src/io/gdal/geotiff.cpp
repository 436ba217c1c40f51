// GeoTIFF, by GDAL, in memory.
#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>

#include <limits>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/raster_source.h"

namespace scarp {
namespace {

tl::unexpected<Error> refuse_geotiff(const std::string& why) {
  return fail(ErrorKind::kOutput, "the raster cannot be encoded as GeoTIFF: " + why);
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_geotiff(const RasterImage& raster) {
  gdal::Session session;
  session.set_option("GDAL_PAM_ENABLED", "NO");  // no .aux.xml beside it
  GDALDriverH driver = GDALGetDriverByName("GTiff");
  if (driver == nullptr) return refuse_geotiff("this GDAL has no GTiff driver");
  gdal::Crs crs;
  if (raster.like != nullptr && !raster.like->crs.empty()) {
    crs = gdal::find_crs(raster.like->crs);
    if (!crs) return refuse_geotiff(fmt::format("'{}' is no CRS that GDAL knows", raster.like->crs));
  }
  const gdal::MemoryFile file("tif");
  const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3",      "TILED=YES",
                           "NUM_THREADS=1",    "BIGTIFF=IF_SAFER", nullptr};
  gdal::Dataset dataset(GDALCreate(driver, file.name(), raster.cols, raster.rows, 1, GDT_Float32, options));
  if (!dataset) return refuse_geotiff(session.reason());
  bool good = true;
  if (raster.like != nullptr && raster.like->has_georeference) {
    std::array<double, 6> geotransform = raster.like->geotransform;
    good = GDALSetGeoTransform(dataset.get(), geotransform.data()) == CE_None;
  }
  if (crs) good = good && GDALSetSpatialRef(dataset.get(), crs.get()) == CE_None;
  GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
  good = good && GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN()) == CE_None;
  if (raster.like != nullptr && !raster.like->unit.empty()) {
    good = good && GDALSetRasterUnitType(band, raster.like->unit.c_str()) == CE_None;
  }
  good =
      good && GDALRasterIOEx(band, GF_Write, 0, 0, raster.cols, raster.rows, const_cast<float*>(raster.samples.data()),
                             raster.cols, raster.rows, GDT_Float32, 0, 0, nullptr) == CE_None;
  dataset.reset();
  if (!good || session.failed()) return refuse_geotiff(session.reason());
  std::vector<std::uint8_t> bytes = file.bytes();
  if (bytes.empty()) return refuse_geotiff("GDAL has written nothing");
  return bytes;
}

}  // namespace scarp
