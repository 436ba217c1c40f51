// Coordinate reference systems.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::gdal {

struct DestroyCrs {
  void operator()(OGRSpatialReferenceH crs) const { OSRDestroySpatialReference(crs); }
};
/// Two-dimensional, x (east, longitude) before y (north, latitude), unless stated otherwise.
using Crs = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyCrs>;

/// The declared CRS of the raster, with its vertical datum and its own order of axes; null if none. CF files in degrees
/// without a datum are in WGS 84.
Crs declared_crs(GDALDatasetH dataset);
/// The raster's CRS; null if none.
Crs crs_of(GDALDatasetH dataset);
/// A copy; null for null and for a CRS without a name.
Crs copy_crs(OGRSpatialReferenceH borrowed);

/// Like find_crs(), but preserves a vertical datum and the order of axes.
Crs find_declared_crs(const std::string& definition);
/// The CRS of data in memory, by find_declared_crs(); null for none. Fails with kUsage if GDAL does not know it.
Result<Crs> find_crs_of(const std::string& name, const std::string& definition);
/// The CRS that an option names: "EPSG:32611", "32611", WKT, a PROJ string. Null if GDAL does not know it.
Crs find_crs(const std::string& definition);

/// "EPSG:32611" if its authority code is known, else WKT.
std::string crs_name(const Crs& crs);
/// WKT of 2019, which supports vertical datums. Empty for null.
std::string wkt_with_heights(const Crs& crs);
/// "EPSG:26917+5703" if both parts of a compound CRS are known, "EPSG:4979" for a three-dimensional one; else empty.
std::string name_with_heights(const Crs& crs);
/// "EPSG:32611", or the name in the WKT: short enough for a sentence.
std::string short_name(const Crs& crs);

bool same_crs(const Crs& a, const Crs& b);

/// Fails with kInput if the CRS is in degrees and the centre is far outside the range of degrees. `way`: the command
/// that sets another CRS.
Result<void> verify_degrees(const Crs& crs, const std::array<double, 2>& centre, const std::string& path,
                            const std::string& way);

/// The conversion from one CRS to another by PROJ. A GDAL handle serves one call at a time. Idle handles are pooled,
/// and a new one is created when all are in use.
class Passage {
 public:
  /// `is_strict`: use only operations that PROJ knows to be correct and whose grids are on this machine.
  Passage(const Crs& from, const Crs& to, bool is_strict = false);

  /// False if PROJ knows no conversion.
  bool usable() const;
  /// Maps the points in place; `z` is empty for two-dimensional points. Points without an image become NaN; returns
  /// false if there are any.
  bool apply(std::span<double> x, std::span<double> y, std::span<double> z) const;

 private:
  struct Destroy {
    void operator()(OGRCoordinateTransformationH handle) const;
  };
  using Handle = std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, Destroy>;
  Handle take() const;
  void give_back(Handle handle) const;

  Crs from_, to_;
  bool is_strict_;
  mutable std::mutex mutex_;
  mutable std::vector<Handle> idle_;
};

/// The conversion from one CRS to another by PROJ. A point's image depends only on the point, not on the thread or the
/// other points of a call. Null if PROJ knows no conversion.
std::shared_ptr<const PointTransform> build_transform(const Crs& from, const Crs& to);

}  // namespace scarp::gdal
