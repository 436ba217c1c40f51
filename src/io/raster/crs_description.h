// The coordinate reference system of a file, without GDAL's headers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#pragma GCC visibility push(default)

namespace scarp::io {

struct CrsDescription {
  std::string name;            ///< "WGS 84 / UTM zone 11N"
  std::string epsg;            ///< "32611"; empty if EPSG has no number for it
  std::string wkt;             ///< OGC's WKT 1, one line
  bool is_geographic = false;  ///< in degrees
  double unit_in_metres = 1;   ///< unit of x and y, unless geographic
};

/// False in a build without GDAL.
bool can_describe_crs();

/// The description of a CRS named as in RasterInfo::crs; nothing if it is unknown, and in a build without GDAL.
std::optional<CrsDescription> describe_crs(const std::string& crs);

/// The unmodified records of a GeoTIFF that hold its CRS.
struct GeoKeys {
  std::span<const std::uint8_t> directory, doubles, texts;
};

/// WKT of a CRS that keys describe by its parameters; empty if GDAL cannot convert them, and in a build without GDAL.
std::string describe_geo_keys(const GeoKeys& keys);

}  // namespace scarp::io

#pragma GCC visibility pop
