// The options of every command that reads a raster.
#pragma once

#include <optional>

#include "scarp/io.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// How the rasters are read: band, extent, resolution, coding, CRS and heights.
Result<ReadOptions> parse_reading(const GivenOptions& given);
/// Completes the library's error about a raster that cannot be read: what else standard input and vector data can be.
Error explain_reading(const GivenOptions& given, Error error);
/// --nodata: a number or NaN, nothing where it is not given. Fails with kUsage for another word.
Result<std::optional<double>> parse_nodata(const GivenOptions& given);
/// The farthest sample to fill from; without the option 100 if nodata is filled, else 0.
Result<double> parse_fill_distance(const GivenOptions& given, bool is_filled);

}  // namespace scarp::cli
