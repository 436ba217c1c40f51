// The readers behind read_points().
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/points.h"

namespace scarp {

/// True if the bytes may be text of columns that begins with numbers.
bool looks_like_columns(std::span<const std::uint8_t> head);

/// Text of columns; see read_points().
Result<PointSet> decode_columns(std::span<const std::uint8_t> bytes, const std::string& name,
                                const ReadPointsOptions& options);

/// read_points() for everything that has no reader of our own; may throw std::bad_alloc. In a build without GDAL it
/// fails with kInput and says so.
Result<PointSet> read_gdal_points(const std::string& path, const ReadPointsOptions& options);

/// True if GDAL's raster drivers open the path, and not as text of columns; false in a build without GDAL.
bool opens_as_raster(const std::string& path);

}  // namespace scarp
