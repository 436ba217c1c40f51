#include "session/reports/place.h"

#include <fmt/format.h>

#include "scarp/io.h"
#include "session/text/json_text.h"

namespace scarp::cli {

std::optional<Place> find_place(const RasterInfo& info, const std::array<std::int32_t, 2>& at) {
  if (at[0] < 0 || !info.has_georeference) return std::nullopt;
  const auto& gt = info.geotransform;
  const double col = at[0] + 0.5, row = at[1] + 0.5;
  Place place{gt[0] + gt[1] * col + gt[2] * row, gt[3] + gt[4] * col + gt[5] * row, info.crs, info.is_geographic, {}};
  if (!info.crs.empty()) place.degrees = find_degrees(info.crs, place.x, place.y);
  return place;
}

std::string describe(const Place& place) {
  const std::string crs = place.crs.empty() ? "" : " in " + crs_words(place.crs);
  const auto degrees = [](double longitude, double latitude) {
    return fmt::format("longitude {:.7g}, latitude {:.7g}", longitude, latitude);
  };
  if (place.is_geographic) return degrees(place.x, place.y) + crs;
  return fmt::format("x {:.10g}, y {:.10g}{}{}", place.x, place.y, crs,
                     place.degrees ? ", " + degrees((*place.degrees)[0], (*place.degrees)[1]) : "");
}

Json to_json(const std::optional<Place>& place) {
  if (!place) return nullptr;
  const auto degree = [&](std::size_t k) { return place->degrees ? Json((*place->degrees)[k]) : Json(nullptr); };
  return Json{{"x", place->x}, {"y", place->y}, {"crs", place->crs}, {"longitude", degree(0)}, {"latitude", degree(1)}};
}

std::string crs_words(const std::string& crs) {
  if (crs.empty()) return "none";
  const std::size_t open = crs.find('"');
  if (open == std::string::npos) return crs;
  return crs.substr(open + 1, crs.find('"', open + 1) - open - 1);
}

std::string unit_words(const std::string& unit) {
  if (unit.empty() || unit == "unknown unit") return "CRS units";
  if (unit == "Meter" || unit == "meter" || unit == "m") return "metres";
  if (unit.ends_with("foot") || unit.ends_with("Foot")) return unit.substr(0, unit.size() - 3) + "eet";
  return unit + "s";
}

}  // namespace scarp::cli
