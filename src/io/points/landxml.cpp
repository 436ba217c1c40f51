#include "io/points/landxml.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "io/mesh/mesh_file_text.h"
#include "io/raster/crs_description.h"

namespace scarp::io {
namespace {

HeightUnit unit_of(const std::string& linear_unit) {
  const std::string name = linear_unit == "USSurveyFoot" ? "US survey foot" : linear_unit;
  return {name, find_metres(name).value_or(0)};
}

}  // namespace

void LandXmlHead::read(const XmlReader& xml) {
  const std::string_view name = xml.name();
  if (name == "Metric" || name == "Imperial") {
    linear_unit = xml.attribute("linearUnit");
    elevation_unit = xml.attribute("elevationUnit");
  } else if (name == "CoordinateSystem") {
    const std::string code = xml.attribute("epsgCode");
    crs = code.empty() ? xml.attribute("ogcWktCode") : "EPSG:" + code;
  }
}

HeightUnit LandXmlHead::unit() const { return unit_of(linear_unit); }

HeightUnit LandXmlHead::height_unit() const { return elevation_unit.empty() ? unit() : unit_of(elevation_unit); }

bool LandXmlHead::has_crs() const { return !crs.empty() && (!can_describe_crs() || describe_crs(crs)); }

Result<void> LandXmlHead::check(const std::string& path) const {
  const HeightUnit here = unit();
  const auto known = describe_crs(crs);
  if (!known || known->is_geographic || here.metres == 0 || std::abs(here.metres / known->unit_in_metres - 1) <= 1e-5)
    return {};
  return fail(ErrorKind::kInput, fmt::format("{}: its unit is {}, and that of its CRS, {}, is {:.9g} m: correct "
                                             "linearUnit or epsgCode in the file",
                                             path, here.name, known->name, known->unit_in_metres));
}

std::string warn_of_unknown_crs(const LandXmlHead& head, const std::string& path) {
  return fmt::format("{}: its CRS, {}, is unknown here: x and y count as having none", path, head.crs.substr(0, 60));
}

std::string at_line(const XmlReader& xml, const std::string& why) {
  return why.empty() ? why : fmt::format("line {}: {}", xml.line(), why);
}

std::string read_numbers(const std::string& text, std::vector<double>& numbers) {
  numbers.clear();
  TextCursor cursor({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  for (std::string_view word = cursor.word_anywhere(); !word.empty(); word = cursor.word_anywhere()) {
    numbers.emplace_back();
    if (!parse_number(word, numbers.back()) || !std::isfinite(numbers.back()))
      return fmt::format("'{}' is no finite number", std::string(word.substr(0, 40)));
  }
  return {};
}

}  // namespace scarp::io
