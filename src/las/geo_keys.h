// The coordinate reference system of a LAS file: WKT, or the keys of GeoTIFF (OGC 19-008r4).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scarp::las {

/// The codes are EPSG's; 0: none, or user-defined.
struct CrsFacts {
  std::string wkt;
  int projected = 0, geographic = 0, vertical = 0;
  int vertical_unit = 0;  ///< 9001: metre, 9002: foot, 9003: US survey foot
  bool is_geographic = false;
  std::string citation;  ///< the CRS's name in words
  bool is_user_defined = false;
  std::vector<std::uint8_t> directory, doubles, texts;  ///< the records of GeoTIFF keys

  /// "EPSG:26910+5703", "EPSG:4326", WKT; empty if the file has neither codes nor WKT.
  std::string definition() const;
  /// True if x and y are degrees, according to the keys, or else to the WKT.
  bool is_degrees() const;
};

/// Reads the keys in the directory.
void read_geo_keys(CrsFacts& crs);

/// The text up to the first zero byte, without blanks at its ends.
std::string text_of(std::span<const std::uint8_t> bytes);

}  // namespace scarp::las
