#include "las/geo_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "las/bytes.h"

namespace scarp::las {
namespace {

enum GeoKey : std::uint16_t {
  kModelType = 1024,
  kCitation = 1026,
  kGeodeticCrs = 2048,
  kGeodeticCitation = 2049,
  kProjectedCrs = 3072,
  kProjectedCitation = 3073,
  kVerticalCrs = 4096,
  kVerticalUnits = 4099,
};

constexpr std::uint16_t kUserDefined = 32767, kLatitudeAndLongitude = 2;

/// The EPSG code; 0 for none.
int code_of(std::uint16_t value) { return value >= 1024 && value < kUserDefined ? value : 0; }

/// The vertical CRS for GeoTIFF 1.0's own numbers; else the code.
int vertical_code_of(std::uint16_t value) {
  switch (value) {
    case 5101:
      return 5701;
    case 5102:
      return 5702;
    case 5103:
      return 5703;
    default:
      return code_of(value);
  }
}

std::string citation_of(std::span<const std::uint8_t> texts, std::size_t count, std::size_t at) {
  if (at >= texts.size()) return "";
  std::string text = text_of(texts.subspan(at, std::min(count, texts.size() - at)));
  while (text.ends_with('|')) text.pop_back();
  return text;
}

}  // namespace

std::string text_of(std::span<const std::uint8_t> bytes) {
  std::string text(bytes.begin(), std::find(bytes.begin(), bytes.end(), 0));
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
  return text;
}

std::string CrsFacts::definition() const {
  if (!wkt.empty()) return wkt;
  const int code = projected != 0 ? projected : is_user_defined ? 0 : geographic;
  if (code == 0) return "";
  return vertical != 0 ? fmt::format("EPSG:{}+{}", code, vertical) : fmt::format("EPSG:{}", code);
}

bool CrsFacts::is_degrees() const {
  if (wkt.empty()) return is_geographic;
  return wkt.find("PROJC") == std::string::npos && wkt.find("GEOG") != std::string::npos;
}

void read_geo_keys(CrsFacts& crs) {
  const std::span<const std::uint8_t> directory = crs.directory;
  constexpr std::size_t kEntry = 8;  // key, location, count, value
  constexpr std::uint16_t kHere = 0, kTexts = 34737;
  if (directory.size() < kEntry) return;
  const std::size_t count =
      std::min<std::size_t>(load<std::uint16_t>(directory.data() + 6), directory.size() / kEntry - 1);
  for (std::size_t k = 1; k <= count; ++k) {
    const std::uint8_t* const entry = directory.data() + k * kEntry;
    const auto key = load<std::uint16_t>(entry), place = load<std::uint16_t>(entry + 2),
               value = load<std::uint16_t>(entry + 6);
    const bool is_citation = key == kCitation || key == kGeodeticCitation || key == kProjectedCitation;
    if (is_citation && place == kTexts && (crs.citation.empty() || key == kProjectedCitation))
      crs.citation = citation_of(crs.texts, load<std::uint16_t>(entry + 4), value);
    if (place != kHere) continue;
    if (key == kModelType) crs.is_geographic = value == kLatitudeAndLongitude;
    if (key == kGeodeticCrs) crs.geographic = code_of(value);
    if (key == kProjectedCrs) crs.projected = code_of(value);
    if (key == kProjectedCrs && value == kUserDefined) crs.is_user_defined = true;
    if (key == kVerticalCrs) crs.vertical = vertical_code_of(value);
    if (key == kVerticalUnits) crs.vertical_unit = code_of(value);
  }
  if (crs.projected != 0) crs.is_geographic = false;
  // If a projected CRS has no code, the code of its geographic CRS does not identify it.
  if (!crs.is_geographic && crs.projected == 0) crs.is_user_defined = crs.is_user_defined || crs.geographic != 0;
}

}  // namespace scarp::las
