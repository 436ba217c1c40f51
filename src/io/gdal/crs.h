// Coordinate reference systems.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <memory>
#include <string>
#include <type_traits>

#include "scarp/frame.h"
#include "scarp/result.h"

namespace scarp::gdal {

struct DestroyCrs {
  void operator()(OGRSpatialReferenceH crs) const { OSRDestroySpatialReference(crs); }
};
/// Always two-dimensional, x (east, longitude) before y (north, latitude).
using Crs = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyCrs>;

/// The raster's CRS; null if it has none.
Crs crs_of(GDALDatasetH dataset);
/// Null for null and for a CRS without a name.
Crs copy_crs(OGRSpatialReferenceH borrowed);

/// From an option: "EPSG:32611", "32611", WKT, a PROJ string. Null if GDAL does not know it.
Crs find_crs(const std::string& definition);

/// "EPSG:32611" where an authority is known, else WKT.
std::string crs_name(const Crs& crs);
/// "EPSG:32611", or the name in the WKT: short enough for a sentence.
std::string short_name(const Crs& crs);

bool same_crs(const Crs& a, const Crs& b);

/// From one CRS to another, through PROJ. The point's image depends on nothing but the point: not on the thread, not on
/// the other points of a call. Null if PROJ knows no way.
std::shared_ptr<const PointTransform> build_transform(const Crs& from, const Crs& to);

}  // namespace scarp::gdal
