#include "io/gdal/georeference.h"
#include "io/gdal/session.h"
#include "io/lent.h"

namespace scarp::io {

Result<Frame> place_lent_raster(const LentRaster& raster, const ReadOptions& options, RasterInfo& info) {
  gdal::Session session;
  const std::string definition = raster.crs.empty() && raster.is_geographic ? "EPSG:4326" : raster.crs;
  SCARP_TRY(const auto& declared, gdal::find_crs_of(info.path, definition));
  const auto geo = gdal::make_georeference(raster.cols, raster.rows, *raster.geotransform,
                                           gdal::copy_crs(declared.get()), gdal::space_crs_of(declared));
  gdal::describe_georeference(geo, info);
  return gdal::choose_frame(geo, options, info);
}

}  // namespace scarp::io
