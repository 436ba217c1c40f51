// The position of a raster on the plane of a local grid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/commands.h"
#include "io/globe_place.h"

namespace scarp::io {
namespace {

/// Cells of a tile; the value does not affect the centre.
constexpr int kAnyCells = 128;

/// Largest distance of a plane from the globe without a warning, relative to the distance from the centre to a corner.
/// On the earth, corners 127 km from the centre reach it.
constexpr double kWorthSaying = 0.01;

/// Warns if the raster covers too large a part of a globe for a plane.
std::vector<std::string> warn_of_distance(const PlaneOnGlobe& on_globe, const RasterOnPlane& plane, int cols, int rows,
                                          const std::string& path) {
  const double way = std::hypot(plane.cell_x * (cols - 1), plane.cell_y * (rows - 1)) / 2;
  const double off = std::hypot(on_globe.off_along, on_globe.off_height);
  if (!(off > kWorthSaying * way)) return {};
  return {
      fmt::format("parts of {} lie up to {:.3g} km from their place on the globe, {:.2g} % of the way from its centre "
                  "to a corner: a plane is too flat for it, take --grid geographic",
                  path, off / 1000, 100 * off / way)};
}

/// The EPSG code of the UTM zone that contains the middle of a raster in degrees.
std::string utm_code(const RasterInfo& info, int cols, int rows) {
  const std::array<double, 6>& gt = info.geotransform;
  const double east = gt[0] + (gt[1] * cols + gt[2] * rows) / 2, north = gt[3] + (gt[4] * cols + gt[5] * rows) / 2;
  const int zone = std::clamp(static_cast<int>(std::floor((std::remainder(east, 360.0) + 180) / 6)) + 1, 1, 60);
  return fmt::format("{}{:02}", north < 0 ? 327 : 326, zone);
}

}  // namespace

Result<void> check_metres(const RasterInfo& info, const std::string& path) {
  if (info.unit_in_metres == 1) return {};
  return fail(ErrorKind::kInput, fmt::format("the heights of {} are in {}, and tiles need metres: read them with "
                                             "HeightsIn::kMetres",
                                             path, info.unit.empty() ? info.crs_unit : info.unit));
}

GridKind grid_for(const RasterInfo& info) {
  return !info.has_georeference || info.crs.empty() || is_local_crs(info) ? GridKind::kLocal : GridKind::kGeographic;
}

Result<RasterOnPlane> place_on_plane(const RasterInfo& info, int cols, int rows, const std::optional<double>& cell_size,
                                     const Datum& datum) {
  const std::array<double, 6>& gt = info.geotransform;
  if (info.has_georeference && info.is_geographic)
    return fail(
        ErrorKind::kInput,
        fmt::format("{} is in degrees, and a local grid lies on a plane: put it into metres ({}), or take --grid "
                    "geographic",
                    info.path, warp_command("-t_srs EPSG:" + utm_code(info, cols, rows), info.path)));
  if (info.has_georeference && (gt[2] != 0 || gt[4] != 0 || !(gt[1] > 0) || !(gt[5] < 0)))
    return fail(ErrorKind::kInput, fmt::format("{} is turned or mirrored in its CRS, and rows of a local grid go from "
                                               "west to east, the northern first: put it straight ({})",
                                               info.path, warp_command("", info.path)));
  RasterOnPlane plane;
  if (info.has_georeference) {
    const bool are_metres = info.cell_x_m > 0;
    plane.cell_x = are_metres ? info.cell_x_m : info.cell_x;
    plane.cell_y = are_metres ? info.cell_y_m : info.cell_y;
    plane.units = are_metres ? "metre" : "unit of the raster's x and y";
  } else {
    plane.cell_x = plane.cell_y = cell_size.value_or(1);
    plane.units = cell_size ? "metre" : "cell";
  }
  if (plane.units == "metre") {
    SCARP_RETURN_IF_ERROR(check_metres(info, info.path));
  }
  if (grid_for(info) == GridKind::kLocal) {
    if (datum.ellipsoid)
      return fail(ErrorKind::kUsage, fmt::format("{} has no place on a globe: leave --ellipsoid out", info.path));
    if (datum.vertical != Vertical::kAuto && datum.vertical != Vertical::kNone)
      return fail(ErrorKind::kUsage, fmt::format("{} has no place on the globe: leave --vertical and --geoid out, its "
                                                 "heights are taken as they are",
                                                 info.path));
    plane.vertical = info.vertical.empty() ? "a surface that nobody names" : info.vertical;
    return plane;
  }
  Datum known = datum;
  if (datum.vertical == Vertical::kAuto && !info.is_ellipsoidal && info.vertical.empty())
    known.vertical = Vertical::kNone;
  SCARP_TRY(auto&& globe, place_on_globe(info, cols, rows, known, info.path));
  plane.vertical = globe.vertical;
  plane.ellipsoid = globe.ellipsoid;
  plane.body = globe.body;
  SCARP_TRY(
      auto&& on_globe,
      find_plane_on_globe(info, TileGrid::of_raster(cols, rows, plane.cell_x, plane.cell_y, kAnyCells).local, globe));
  plane.warnings = warn_of_distance(on_globe, plane, cols, rows, info.path);
  plane.globe = std::move(on_globe);
  plane.samples = std::move(globe);
  return plane;
}

}  // namespace scarp::io
