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
/// Always two-dimensional, x (east, longitude) before y (north, latitude).
using Crs = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, DestroyCrs>;

/// The CRS that the raster declares, with a vertical datum and in its own order of axes; null if it has none.
/// Coordinates of CF files in degrees without more are those of WGS 84.
Crs declared_crs(GDALDatasetH dataset);
/// The raster's CRS; null if it has none.
Crs crs_of(GDALDatasetH dataset);
/// Null for null and for a CRS without a name.
Crs copy_crs(OGRSpatialReferenceH borrowed);

/// Like find_crs(), with a vertical datum and the order of axes as they are.
Crs find_declared_crs(const std::string& definition);
/// The CRS of what is in memory, as find_declared_crs(); null for none. kUsage if GDAL does not know it.
Result<Crs> find_crs_of(const std::string& name, const std::string& definition);
/// From an option: "EPSG:32611", "32611", WKT, a PROJ string. Null if GDAL does not know it.
Crs find_crs(const std::string& definition);

/// "EPSG:32611" where an authority is known, else WKT.
std::string crs_name(const Crs& crs);
/// WKT of 2019, which knows vertical datums. Empty for null.
std::string wkt_with_heights(const Crs& crs);
/// "EPSG:26917+5703" where both parts of a compound CRS are known, "EPSG:4979" for one of three dimensions; else empty.
std::string name_with_heights(const Crs& crs);
/// "EPSG:32611", or the name in the WKT: short enough for a sentence.
std::string short_name(const Crs& crs);

bool same_crs(const Crs& a, const Crs& b);

/// kInput for a centre that is far from all degrees, in a CRS of degrees. `way`: the command that names another CRS.
Result<void> verify_degrees(const Crs& crs, const std::array<double, 2>& centre, const std::string& path,
                            const std::string& way);

/// The way from one CRS to another, through PROJ. A handle of GDAL's serves one call at a time; idle ones wait in a
/// pool, and a new one is made when all are out.
class Passage {
 public:
  /// `is_strict`: only by a way that PROJ knows to be right, with the grids of it on this machine.
  Passage(const Crs& from, const Crs& to, bool is_strict = false);

  /// False if PROJ knows no way.
  bool usable() const;
  /// Maps the points in place; `z` is empty for points of a map. Returns false if any point has no image (it is then
  /// NaN).
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

/// From one CRS to another, through PROJ. The point's image depends on nothing but the point: not on the thread, not on
/// the other points of a call. Null if PROJ knows no way.
std::shared_ptr<const PointTransform> build_transform(const Crs& from, const Crs& to);

}  // namespace scarp::gdal
