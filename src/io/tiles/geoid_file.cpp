// Reads a reference surface of heights from a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/globe_place.h"
#include "scarp/io.h"
#include "scarp/tile.h"

namespace scarp::io {
namespace {

/// Largest distance in metres between a geoid of the earth and the ellipsoid.
constexpr double kMostGeoid = 150;

}  // namespace

Result<Zero> read_geoid(const Datum& datum, const RasterOnGlobe& globe) {
  ReadOptions options;
  options.crs = "source";
  options.as_values = true;
  options.heights_in = HeightsIn::kMetres;
  SCARP_TRY(auto&& field, read_height_field(datum.geoid, options));
  Datum as_it_is;
  as_it_is.vertical = Vertical::kNone;
  as_it_is.ellipsoid = datum.ellipsoid;
  SCARP_TRY(auto&& place, place_on_globe(field.info, field.cols, field.rows, as_it_is, datum.geoid));
  if (std::abs(place.ellipsoid.semi_major / globe.ellipsoid.semi_major - 1) > 0.01)
    return fail(ErrorKind::kUsage, fmt::format("{} is of another globe, {:.0f} m in radius and not {:.0f}", datum.geoid,
                                               place.ellipsoid.semi_major, globe.ellipsoid.semi_major));
  const double reach = std::max(std::abs(field.info.min), std::abs(field.info.max));
  const bool is_earth = std::abs(globe.ellipsoid.semi_major / Geodetic{}.semi_major - 1) <= 0.01;
  if (is_earth && reach > kMostGeoid)
    return fail(ErrorKind::kUsage,
                fmt::format("{} holds {} to {} m, and no geoid of the earth is that far from the ellipsoid: give its "
                            "heights above the ellipsoid",
                            datum.geoid, field.info.min, field.info.max));
  SCARP_TRY(auto&& zero, make_grid_zero({field.cols, field.rows, std::move(field.samples), std::move(place.place)}));
  return Zero{std::move(zero), reach};
}

}  // namespace scarp::io
