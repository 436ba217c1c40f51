// The location of a sample in the world.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "session/text/json.h"

namespace scarp::cli {

/// A place in the source's own CRS.
struct Place {
  double x = 0, y = 0;
  std::string crs;                               ///< like RasterInfo::crs
  bool is_geographic = false;                    ///< x and y are longitude and latitude
  std::optional<std::array<double, 2>> degrees;  ///< longitude and latitude, if the CRS is known
};

/// The place of the sample at (column, row). Nothing for (-1, -1) or without georeference.
std::optional<Place> find_place(const RasterInfo& info, const std::array<std::int32_t, 2>& at);

/// "x 376328.4, y 3807902.1 in EPSG:32611, longitude -118.2913, latitude 34.36072".
std::string describe(const Place& place);
/// {"x", "y", "crs", "longitude", "latitude"}; null without a place.
Json to_json(const std::optional<Place>& place);

/// "EPSG:4326", or the name that a WKT begins with; "none".
std::string crs_words(const std::string& crs);
/// "metres", "degrees", "US survey feet": the unit of x and y, as RasterInfo::crs_unit names it.
std::string unit_words(const std::string& unit);

}  // namespace scarp::cli
