// The header of a LAS or LAZ file, versions 1.0 to 1.4, and the records after it (ASPRS, "LAS Specification 1.4 -
// R15").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "las/bytes.h"
#include "las/geo_keys.h"
#include "las/laz_record.h"
#include "scarp/result.h"

namespace scarp::las {

struct Header {
  unsigned minor_version = 0;  ///< 0 to 4
  unsigned point_format = 0;
  std::uint16_t record_bytes = 0;
  std::uint64_t points = 0, points_offset = 0;
  std::array<double, 3> scale{}, offset{};
  /// The box of the points, according to the header.
  std::array<double, 3> least{}, most{};
  std::optional<LazRecord> laz;  ///< nothing: the points are not compressed
  CrsFacts crs;
};

/// Fails with kInput for any fault that could break the reading of points.
Result<Header> read_header(const Source& source);

}  // namespace scarp::las
