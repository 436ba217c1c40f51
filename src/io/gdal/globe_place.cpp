// The position of a raster on the globe: conversions to longitude, latitude and heights above the ellipsoid.
#include "io/globe_place.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "io/commands.h"
#include "io/gdal/crs.h"
#include "io/gdal/session.h"
#include "scarp/tile.h"

namespace scarp::io {
namespace {

using gdal::Crs;
using gdal::Passage;

/// Largest difference in degrees between two geodetic datums treated as equal, for rasters in degrees.
constexpr double kSameDegrees = 1e-9;

/// A three-dimensional CRS with axes in the order x, y, height; null if GDAL does not know it.
Crs find_space_crs(const std::string& definition) {
  Crs crs(OSRNewSpatialReference(nullptr));
  if (OSRSetFromUserInput(crs.get(), definition.c_str()) != OGRERR_NONE) return nullptr;
  OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

/// Finds the zero of heights by PROJ, from the raster's own x and y if the zero belongs to their CRS.
class ProjZero final : public HeightZero {
 public:
  /// `from_degrees`: null if x and y are degrees.
  ProjZero(std::shared_ptr<const PointTransform> from_degrees, const Crs& heights, const Crs& ellipsoid)
      : from_degrees_(std::move(from_degrees)), way_(heights, ellipsoid, true) {}

  bool usable() const { return way_.usable(); }
  void find(std::span<const double> longitudes, std::span<const double> latitudes,
            std::span<double> heights) const override {
    std::vector<double> x(longitudes.begin(), longitudes.end()), y(latitudes.begin(), latitudes.end());
    std::fill(heights.begin(), heights.end(), 0.0);
    if (from_degrees_ != nullptr) from_degrees_->apply(x, y);
    way_.apply(x, y, heights);
  }

 private:
  std::shared_ptr<const PointTransform> from_degrees_;
  Passage way_;
};

/// Degrees on the earth if a conversion exists, else, for another planet, on the raster's own ellipsoid.
struct Degrees {
  Crs crs;
  Geodetic ellipsoid;
  std::string body;
};

bool is_earth(const Geodetic& ellipsoid) { return std::abs(ellipsoid.semi_major / Geodetic{}.semi_major - 1) <= 0.01; }

Degrees choose_degrees(const Crs& source, const std::optional<Geodetic>& given) {
  OGRErr error = OGRERR_NONE;
  Geodetic own;
  own.semi_major = OSRGetSemiMajor(source.get(), &error);
  own.inverse_flattening = OSRGetInvFlattening(source.get(), &error);
  if (error != OGRERR_NONE) own = {};
  if (!given && is_earth(own)) return {gdal::find_crs("EPSG:4326"), {}, ""};
  const Crs degrees(OSRCloneGeogCS(source.get()));
  const char* name = given ? nullptr : OSRGetAttrValue(degrees.get(), "SPHEROID", 0);
  return {gdal::copy_crs(degrees.get()), given.value_or(own), name != nullptr ? name : "none"};
}

bool is_same_point(const PointTransform& transform, double x, double y) {
  double mapped_x = x, mapped_y = y;
  return transform.apply({&mapped_x, 1}, {&mapped_y, 1}) && std::abs(mapped_x - x) < kSameDegrees &&
         std::abs(mapped_y - y) < kSameDegrees;
}

/// True if positions of the raster are recovered from their degrees. Beyond 180° of a cylindrical projection, the
/// inverse is wrong by a whole turn.
bool is_found_again(int cols, int rows, const RasterOnGlobe& globe) {
  const std::array<double, 6>& a = globe.place.affine;
  const double cell = std::hypot(a[1], a[4]) + std::hypot(a[2], a[5]);
  constexpr int kPlaces = 33;
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i) {
      const double col = (cols - 1.0) * i / (kPlaces - 1), row = (rows - 1.0) * j / (kPlaces - 1);
      const double from_x = a[0] + a[1] * col + a[2] * row, from_y = a[3] + a[4] * col + a[5] * row;
      double x = from_x, y = from_y;
      if (!globe.to_degrees->apply({&x, 1}, {&y, 1}) || !globe.place.from_degrees->apply({&x, 1}, {&y, 1})) continue;
      if (std::abs(x - from_x) + std::abs(y - from_y) > cell) return false;
    }
  }
  return true;
}

/// PROJ's name for EGM96 heights.
constexpr const char* kEgm96Heights = "EGM96 height";
constexpr int kEgm96Epsg = 5773;
/// Largest distance in metres between a geoid of the earth and the ellipsoid.
constexpr double kGeoidReach = 110;

constexpr const char* kWaysOut =
    "give --vertical egm96 for heights above the sea, --vertical ellipsoid for heights above the ellipsoid, as GPS "
    "gives "
    "them, or --geoid FILE, a grid of the surface that they are above";
constexpr const char* kWaysOutElsewhere =
    "give --vertical ellipsoid for heights above its ellipsoid, or --geoid FILE, a grid of the surface that they are "
    "above";

/// Finds the zero of heights above a surface that PROJ can convert from.
Result<void> find_zero_by_proj(const RasterInfo& info, const Datum& datum, const std::string& path,
                               RasterOnGlobe& globe) {
  std::shared_ptr<const PointTransform> to_xy;
  std::string definition = info.crs_with_heights;
  if (datum.vertical == Vertical::kEpsg) {
    const Crs alone(OSRNewSpatialReference(nullptr));
    if (OSRImportFromEPSG(alone.get(), datum.epsg) != OGRERR_NONE || OSRIsVertical(alone.get()) == 0 ||
        OSRIsCompound(alone.get()) != 0)
      return fail(ErrorKind::kUsage,
                  fmt::format("EPSG:{} is no vertical CRS: give one, such as EPSG:5703 (NAVD88)", datum.epsg));
    globe.vertical = OSRGetName(alone.get());
    definition = fmt::format("EPSG:4326+{}", datum.epsg);
  } else {
    globe.vertical = info.vertical;
    to_xy = globe.place.from_degrees;
  }
  const Crs heights = find_space_crs(definition), ellipsoid = find_space_crs("EPSG:4979");
  auto zero = heights && ellipsoid ? std::make_shared<ProjZero>(to_xy, heights, ellipsoid) : nullptr;
  const std::array<double, 6>& gt = info.geotransform;
  double x = gt[0], y = gt[3];
  if (globe.to_degrees != nullptr) globe.to_degrees->apply({&x, 1}, {&y, 1});
  double height = NAN;
  if (zero != nullptr && zero->usable()) zero->find({&x, 1}, {&y, 1}, {&height, 1});
  if (!std::isfinite(height))
    return fail(ErrorKind::kUsage,
                fmt::format("{}: the way from {} to heights above the ellipsoid is not on this machine: install its "
                            "grid for PROJ (projsync, or Debian's proj-data), or {}",
                            path, globe.vertical, kWaysOut));
  globe.zero = std::move(zero);
  globe.zero_reach = kGeoidReach;
  return {};
}

Result<void> find_zero(const RasterInfo& info, const Datum& datum, const std::string& path, RasterOnGlobe& globe) {
  switch (datum.vertical) {
    case Vertical::kNone:
      globe.vertical = "a surface that nobody names, taken for the ellipsoid";
      return {};
    case Vertical::kGeoid: {
      SCARP_TRY(auto&& zero, read_geoid(datum, globe));
      globe.vertical = fmt::format("the surface in {}", CPLGetFilename(datum.geoid.c_str()));
      globe.zero = std::move(zero.heights);
      globe.zero_reach = zero.reach;
      return {};
    }
    case Vertical::kAuto:
      if (!info.is_ellipsoidal && info.vertical.empty())
        return fail(ErrorKind::kUsage, fmt::format("nobody says what the heights of {} are above{}: {}", path,
                                                   is_earth(globe.ellipsoid) ? ", which may be 100 m apart" : "",
                                                   is_earth(globe.ellipsoid) ? kWaysOut : kWaysOutElsewhere));
      break;
    default:
      break;
  }
  if (datum.vertical == Vertical::kEllipsoid || (datum.vertical == Vertical::kAuto && info.is_ellipsoidal)) {
    globe.vertical = "the ellipsoid";
    return {};
  }
  if (!is_earth(globe.ellipsoid))
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} lies on an ellipsoid of {:.0f} m, which is not the earth's: its heights are not above a "
                    "surface of the earth: {}",
                    path, globe.ellipsoid.semi_major, kWaysOutElsewhere));
  if (datum.vertical == Vertical::kEgm96 || (datum.vertical == Vertical::kEpsg && datum.epsg == kEgm96Epsg) ||
      (datum.vertical == Vertical::kAuto && info.vertical == kEgm96Heights)) {
    globe.vertical = kEgm96Heights;
    globe.zero = egm96();
    globe.zero_reach = kGeoidReach;
    return {};
  }
  return find_zero_by_proj(info, datum, path, globe);
}

}  // namespace

Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, const Datum& datum,
                                     const std::string& path) {
  gdal::Session quiet;
  const Crs source = info.crs.empty() ? nullptr : gdal::find_crs(info.crs);
  if (!info.has_georeference || !source)
    return fail(
        ErrorKind::kInput,
        fmt::format("{} does not say where on the globe it lies: give it a position and a CRS ({}), or take --grid "
                    "local",
                    path, translate_command("-a_srs EPSG:4326 -a_ullr WEST NORTH EAST SOUTH", path)));
  SCARP_RETURN_IF_ERROR(check_metres(info, path));
  RasterOnGlobe globe;
  const Degrees degrees = choose_degrees(source, datum.ellipsoid);
  globe.ellipsoid = degrees.ellipsoid;
  globe.body = degrees.body;
  globe.degrees = degrees.crs ? gdal::crs_name(degrees.crs) : "";
  const std::array<double, 6>& gt = info.geotransform;
  globe.place.affine = {gt[0] + (gt[1] + gt[2]) / 2, gt[1], gt[2], gt[3] + (gt[4] + gt[5]) / 2, gt[4], gt[5]};
  auto forth = degrees.crs ? gdal::build_transform(source, degrees.crs) : nullptr;
  auto back = degrees.crs ? gdal::build_transform(degrees.crs, source) : nullptr;
  if (!forth || !back)
    return fail(ErrorKind::kInput,
                fmt::format("{}: PROJ knows no way from {} to longitude and latitude", path, gdal::short_name(source)));
  const bool are_degrees = info.is_geographic && is_same_point(*forth, globe.place.affine[0], globe.place.affine[3]);
  if (!are_degrees) {
    globe.place.from_degrees = std::move(back);
    globe.to_degrees = std::move(forth);
    globe.place.to_degrees = globe.to_degrees;
    if (!is_found_again(cols, rows, globe))
      return fail(ErrorKind::kInput,
                  fmt::format("{} reaches beyond 180 degrees of its projection, where places are not found again from "
                              "longitude and latitude: put it into degrees ({})",
                              path, warp_command("-t_srs '+proj=longlat +datum=WGS84 +lon_wrap=180'", path)));
  }

  SCARP_RETURN_IF_ERROR(find_zero(info, datum, path, globe));
  return globe;
}

}  // namespace scarp::io
